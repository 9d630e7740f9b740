#pragma once
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/quads/field/frame_field.h"
#include "model/feature_mesh.h"

namespace strataflow {

/// What becomes of a job whose curves defeat a stage of the quad mesher.
struct QuadFallback {
  std::string fallback = "none";
  bool may_fail() const { return fallback == "subdivide"; }
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(fallback, OptionField{.name = "fallback",
                                .description = "Where no map can be found: none fails with the reason; subdivide cuts "
                                               "every triangle into three quads, which always succeeds and is told",
                                .words = {"none", "subdivide"}});
  }
};

/// A stage's output, or why there is none where the job may go on without.
template <class T>
struct Attempt {
  T value;
  std::string why_not;  ///< empty: value counts
  template <class A>
  void archive(A& a) {
    a(value, why_not);
  }
};

/// The value, or what failed in its place if the job may go on.
template <class T>
Result<Attempt<T>> attempted(Result<T> result, const QuadFallback& fallback) {
  if (result) return Attempt<T>{*std::move(result), {}};
  const bool is_ours =
      result.failure().code == FailureCode::cancelled || result.failure().code == FailureCode::internal_error;
  if (!fallback.may_fail() || is_ours) return result.failure();
  return Attempt<T>{{}, result.failure().what};
}

/// Curves that the map need not follow.
struct LooseCurves {
  std::vector<std::string> loose;
  bool imprint = true;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(loose,
          OptionField{.name = "loose",
                      .description = "Curves that field and map need not follow: whole numbers align them where "
                                     "they can, the others are laid into the quads, which are then divided once"});
    visit(imprint, OptionField{.name = "imprint",
                               .description = "Whether curves that no map follows become loose, the one nearest to "
                                              "the fault first, instead of failing the job"});
  }
};

/// The features of these names, ascending. Fails with invalid_options for a name that is none, or on the boundary.
Result<std::vector<std::uint32_t>> loose_features(const FeatureMesh& mesh, const LooseCurves& curves);

/// [quad]: the field.
struct FrameFieldStageOptions {
  FrameFieldOptions field;
  QuadFallback fallback;
  LooseCurves curves{};
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    field.visit_fields(visit);
    fallback.visit_fields(visit);
    curves.visit_fields(visit);
  }
};

/// Directions of quads that stand on every feature that is not loose (coudert2024 S5, S11, S24–S31).
struct ComputeFrameField {
  static constexpr std::string_view name = "frame_field";
  static constexpr int version = 2;
  FrameFieldStageOptions options;

  Result<Attempt<FrameFieldResult>> operator()(const FeatureMesh& mesh, StageContext& context) const;
};

}  // namespace strataflow
