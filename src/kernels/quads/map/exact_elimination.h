#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace strataflow {

/// numerator / denominator, denominator > 0, no common factor.
struct Rational {
  std::int64_t numerator = 0, denominator = 1;
  friend constexpr bool operator==(const Rational&, const Rational&) = default;
  double value() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
};

/// Linear equations with integer coefficients, solved exactly one after the other: every variable becomes an affine
/// form of the variables that stay free. Meant for many short equations (coudert2024 S43: U = M·X + B with ker M = 0).
class ExactElimination {
 public:
  struct Term {
    std::uint32_t variable = 0;
    std::int64_t coefficient = 0;
  };
  struct FormTerm {
    std::uint32_t variable = 0;
    Rational coefficient;
    friend bool operator==(const FormTerm&, const FormTerm&) = default;
  };
  /// Σ terms + constant; terms ascending by variable.
  struct Form {
    std::vector<FormTerm> terms;
    Rational constant;
    friend bool operator==(const Form&, const Form&) = default;
  };
  enum class Outcome {
    used,           ///< one variable less is free
    redundant,      ///< it followed from the earlier ones
    contradiction,  ///< the earlier ones rule it out
    overflow        ///< its numbers do not fit 64 bits
  };

  explicit ExactElimination(std::uint32_t variables) : form_of_(variables, 0), uses_(variables, 0) {}

  /// Σ coefficient · variable = value. Variables may repeat.
  Outcome add(std::span<const Term> terms, std::int64_t value);

  bool is_free(std::uint32_t variable) const { return form_of_[variable] == 0; }

  /// The variable in terms of free ones. Empty and `overflowed()` when numbers do not fit.
  Form resolve(std::uint32_t variable);

  /// Σ coefficient · variable in terms of free ones.
  Form resolve(std::span<const Term> terms);

  bool overflowed() const { return overflowed_; }
  std::uint32_t variable_count() const { return static_cast<std::uint32_t>(form_of_.size()); }

 private:
  Form reduced(Form form);
  Rational sum(Rational a, Rational b);
  Rational product(Rational a, Rational b);
  __extension__ typedef __int128 Wide;  // no more than sums of two products of 64 bits
  Rational made(Wide numerator, Wide denominator);

  std::vector<std::uint32_t> form_of_;  ///< per variable: 0 free, else 1 + place in forms_
  std::vector<std::uint32_t> uses_;     ///< per variable: in how many forms it was put
  std::vector<Form> forms_;
  bool overflowed_ = false;
};

}  // namespace strataflow
