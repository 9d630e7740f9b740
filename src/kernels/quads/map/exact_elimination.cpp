#include "kernels/quads/map/exact_elimination.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace strataflow {

Rational ExactElimination::made(Wide numerator, Wide denominator) {
  Wide a = numerator < 0 ? -numerator : numerator, b = denominator;
  while (b != 0) a = std::exchange(b, a % b);
  if (a > 1) {
    numerator /= a;
    denominator /= a;
  }
  constexpr Wide most = std::numeric_limits<std::int64_t>::max();
  if (numerator > most || numerator < -most || denominator > most) {
    overflowed_ = true;
    return {};
  }
  return {static_cast<std::int64_t>(numerator), static_cast<std::int64_t>(denominator)};
}

Rational ExactElimination::sum(Rational a, Rational b) {
  if (a.denominator == 1 && b.denominator == 1) return made(static_cast<Wide>(a.numerator) + b.numerator, 1);
  Wide left = 0, right = 0, total = 0;
  if (__builtin_mul_overflow(static_cast<Wide>(a.numerator), static_cast<Wide>(b.denominator), &left) ||
      __builtin_mul_overflow(static_cast<Wide>(b.numerator), static_cast<Wide>(a.denominator), &right) ||
      __builtin_add_overflow(left, right, &total)) {
    overflowed_ = true;
    return {};
  }
  return made(total, static_cast<Wide>(a.denominator) * b.denominator);
}

Rational ExactElimination::product(Rational a, Rational b) {
  return made(static_cast<Wide>(a.numerator) * b.numerator, static_cast<Wide>(a.denominator) * b.denominator);
}

ExactElimination::Form ExactElimination::reduced(Form form) {
  const auto ascending = [](const FormTerm& a, const FormTerm& b) { return a.variable < b.variable; };
  while (!overflowed_) {
    Form next;
    next.constant = form.constant;
    bool changed = false;
    for (const FormTerm& term : form.terms) {
      if (is_free(term.variable)) {
        next.terms.push_back(term);
        continue;
      }
      changed = true;
      const Form& replaced = forms_[form_of_[term.variable] - 1];
      next.constant = sum(next.constant, product(term.coefficient, replaced.constant));
      for (const FormTerm& inner : replaced.terms)
        next.terms.push_back({inner.variable, product(term.coefficient, inner.coefficient)});
    }
    std::sort(next.terms.begin(), next.terms.end(), ascending);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < next.terms.size();) {
      FormTerm total = next.terms[i++];
      for (; i < next.terms.size() && next.terms[i].variable == total.variable; ++i)
        total.coefficient = sum(total.coefficient, next.terms[i].coefficient);
      if (total.coefficient.numerator != 0) next.terms[kept++] = total;
    }
    next.terms.resize(kept);
    form = std::move(next);
    if (!changed) break;
  }
  return form;
}

ExactElimination::Form ExactElimination::resolve(std::uint32_t variable) {
  if (is_free(variable)) return {{{variable, {1, 1}}}, {}};
  // Kept resolved, so that chains are walked once.
  Form form = reduced(forms_[form_of_[variable] - 1]);
  forms_[form_of_[variable] - 1] = form;
  return form;
}

ExactElimination::Form ExactElimination::resolve(std::span<const Term> terms) {
  Form form;
  for (const Term& term : terms) {
    const Form one = resolve(term.variable);
    const Rational factor{term.coefficient, 1};
    form.constant = sum(form.constant, product(factor, one.constant));
    for (const FormTerm& inner : one.terms) form.terms.push_back({inner.variable, product(factor, inner.coefficient)});
  }
  return reduced(std::move(form));
}

ExactElimination::Outcome ExactElimination::add(std::span<const Term> terms, std::int64_t value) {
  Form form = resolve(terms);
  form.constant = sum(form.constant, {-value, 1});
  if (overflowed_) return Outcome::overflow;
  if (form.terms.empty()) return form.constant.numerator == 0 ? Outcome::redundant : Outcome::contradiction;
  // The pivot: coefficient of the least size, then least used so far, then the youngest.
  std::size_t best = 0;
  const auto size = [](const Rational& r) {
    return std::max(r.numerator < 0 ? -r.numerator : r.numerator, r.denominator);
  };
  for (std::size_t i = 1; i < form.terms.size(); ++i) {
    const auto key = [&](std::size_t j) {
      return std::pair(size(form.terms[j].coefficient), uses_[form.terms[j].variable]);
    };
    if (key(i) <= key(best)) best = i;
  }
  const FormTerm pivot = form.terms[best];
  form.terms.erase(form.terms.begin() + static_cast<std::ptrdiff_t>(best));
  const bool negative = pivot.coefficient.numerator < 0;
  const Rational factor{negative ? pivot.coefficient.denominator : -pivot.coefficient.denominator,
                        negative ? -pivot.coefficient.numerator : pivot.coefficient.numerator};
  for (FormTerm& term : form.terms) {
    term.coefficient = product(term.coefficient, factor);
    ++uses_[term.variable];
  }
  form.constant = product(form.constant, factor);
  if (overflowed_) return Outcome::overflow;
  forms_.push_back(std::move(form));
  form_of_[pivot.variable] = static_cast<std::uint32_t>(forms_.size());
  return Outcome::used;
}

}  // namespace strataflow
