#pragma once
#include <concepts>
#include <cstddef>
#include <memory>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/digest.h"
#include "base/id.h"
#include "base/result.h"
#include "graph/stage_context.h"

namespace strataflow {

class StageGraph;

/// A node's place in its graph: insertion order, which is also the order of every report.
using NodeId = Id<struct NodeTag>;

/// The receipt for a node that will make a T. Only StageGraph::add hands it out, after the node exists: wiring a cycle
/// or a wrong type does not compile.
template <class T>
class Port {
 public:
  NodeId node() const { return node_; }
  friend bool operator==(const Port&, const Port&) = default;

 private:
  friend class StageGraph;
  explicit Port(NodeId node) : node_(node) {}
  NodeId node_;
};

/// How inputs and outputs travel between nodes, their type known at both ends.
using AnyOutput = std::shared_ptr<const void>;

/// Deals the outputs that reach a node to its stage's parameters, from the left.
struct InputDealer {
  const std::vector<AnyOutput>& outputs;
  const std::vector<std::size_t>& counts;  ///< outputs per parameter
  std::size_t output = 0;
  std::size_t parameter = 0;
};

/// The port a stage's parameter asks for: Port<T> for `const T&`, any number of them for
/// `const std::vector<const T*>&`.
template <class Parameter>
struct InputOf;
template <class T>
struct InputOf<const T&> {
  using Wire = Port<T>;
  static const T& take(InputDealer& dealer) {
    ++dealer.parameter;
    return *static_cast<const T*>(dealer.outputs[dealer.output++].get());
  }
};
template <class T>
struct InputOf<const std::vector<const T*>&> {
  using Wire = std::vector<Port<T>>;
  static std::vector<const T*> take(InputDealer& dealer) {
    std::vector<const T*> values(dealer.counts[dealer.parameter++]);
    for (const T*& value : values) value = static_cast<const T*>(dealer.outputs[dealer.output++].get());
    return values;
  }
};

template <class Out, class Inputs>
struct SignatureWithInputs;
template <class Out, class... Parameters>
struct SignatureWithInputs<Out, std::tuple<Parameters...>> {
  using Output = Out;
  template <class... Wires>
  static constexpr bool accepts = std::is_same_v<std::tuple<Wires...>, std::tuple<typename InputOf<Parameters>::Wire...>>;

  /// Calls the stage with `outputs` dealt to its parameters; `counts` says how many each of them takes.
  template <class Stage>
  static Result<Out> call(const Stage& stage, const std::vector<AnyOutput>& outputs,
                          const std::vector<std::size_t>& counts, StageContext& context) {
    [[maybe_unused]] InputDealer dealer{outputs, counts};
    // Braces: from the left.
    std::tuple<decltype(InputOf<Parameters>::take(dealer))...> arguments{InputOf<Parameters>::take(dealer)...};
    return std::apply([&](const auto&... inputs) { return stage(inputs..., context); }, arguments);
  }
};

/// What a stage's call operator `Result<Output> operator()(inputs…, StageContext&) const` says about its wiring.
template <class Call>
struct StageCall;
template <class Stage, class Out, class... Parameters>
struct StageCall<Result<Out> (Stage::*)(Parameters...) const> {
  using All = std::tuple<Parameters...>;
  static_assert(sizeof...(Parameters) > 0 &&
                    std::is_same_v<std::tuple_element_t<sizeof...(Parameters) - 1, All>, StageContext&>,
                "the last parameter of a stage is StageContext&");
  template <std::size_t... I>
  static std::tuple<std::tuple_element_t<I, All>...> without_context(std::index_sequence<I...>);
  using Signature =
      SignatureWithInputs<Out, decltype(without_context(std::make_index_sequence<sizeof...(Parameters) - 1>{}))>;
};
template <class Stage>
using StageSignature = typename StageCall<decltype(&Stage::operator())>::Signature;

template <class Stage, class... Wires>
concept WiresFit = StageSignature<Stage>::template accepts<Wires...>;

/// A stage that reads files says what they hold: their content becomes part of its key when it runs.
template <class Stage>
concept ReadsFiles = requires(const Stage& stage) {
  { stage.external_digest() } -> std::same_as<Result<Digest>>;
};

/// …and, to be shared by several jobs, which files they are (their absolute paths): `std::string external_identity()`.
template <class Stage>
concept NamesFiles = requires(const Stage& stage) {
  { stage.external_identity() } -> std::convertible_to<std::string>;
};

template <class Stage>
constexpr bool uses_seed() {
  if constexpr (requires { Stage::uses_seed; }) return Stage::uses_seed;
  return false;
}

}  // namespace strataflow
