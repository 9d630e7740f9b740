#include "batch/report/complexity_json.h"

namespace strataflow {
namespace {

using Json = nlohmann::ordered_json;

Json parts_json(const ElementComplexity& sum) {
  return {{"too_small", sum.too_small},
          {"shape", sum.shape},
          {"thin", sum.thin},
          {"sharp", sum.sharp},
          {"total", sum.total()}};
}

Json geometric_json(const GeometricComplexity& geometric) {
  Json elements = Json::array();
  for (const ElementComplexity& one : geometric.elements) {
    Json json = {{"type", one.type == ElementType::region    ? "region"
                          : one.type == ElementType::surface ? "surface"
                                                             : "line"},
                 {"id", one.element},
                 {"size", one.size}};
    json.update(parts_json(one));
    elements.push_back(std::move(json));
  }
  return {{"edge_length_m", geometric.edge_length_m},
          {"angle_deg", geometric.angle_deg},
          {"thickness_spacing_m", geometric.spacing_m},
          {"regions", parts_json(geometric.sum_of(ElementType::region))},
          {"surfaces", parts_json(geometric.sum_of(ElementType::surface))},
          {"lines", parts_json(geometric.sum_of(ElementType::line))},
          {"total", geometric.total()},
          {"elements", elements}};
}

Json spread_json(const LengthDistribution& spread) {
  return {{"length_m", spread.length_m}, {"minimum", spread.minimum}, {"q50", spread.q50},
          {"q90", spread.q90},           {"maximum", spread.maximum}, {"mean", spread.mean}};
}

Json faults_json(const FaultReport& report) {
  Json list = Json::array();
  for (const FaultMeasures& fault : report.faults)
    list.push_back({{"name", fault.name},
                    {"area_m2", fault.area_m2},
                    {"strike_deg", fault.strike_deg},
                    {"dip_deg", fault.dip_deg},
                    {"horizons", fault.horizons},
                    {"layers_affected", fault.layers_affected},
                    {"throw_m", spread_json(fault.throw_m)},
                    {"unmatched_m", fault.unmatched_m},
                    {"horizon_angle_deg", spread_json(fault.horizon_angle_deg)},
                    {"faults", fault.faults},
                    {"fault_angle_deg", spread_json(fault.fault_angle_deg)},
                    {"free_border_m", fault.free_border_m}});
  return list;
}

}  // namespace

nlohmann::ordered_json complexity_json(const ComplexityReport& report) {
  const ElementCounts& counts = report.counts;
  const SizeVariation& variation = report.size_variation;
  const FaultNetworkMeasures& network = report.faults.network;
  Json cells = Json::array();
  for (const CellStatistics& one : report.cells)
    cells.push_back({{"n", one.cells},
                     {"resolution_m", one.resolution_m},
                     {"q10", one.q10},
                     {"q50", one.q50},
                     {"q90", one.q90},
                     {"max", one.max},
                     {"mean", one.mean},
                     {"cv", one.cv},
                     {"above_6", one.above_6},
                     {"needed_edge_m", one.needed_edge_m}});
  Json needs = Json::array();
  for (std::size_t i = 0; i < report.needs.size(); ++i)
    needs.push_back({{"region", i},
                     {"name", report.needs[i].name},
                     {"thinnest_m", report.needs[i].thinnest_m},
                     {"needed_edge_m", report.needs[i].needed_edge_m}});
  return {{"counts",
           {{"regions", counts.regions},
            {"surfaces", counts.surfaces},
            {"lines", counts.lines},
            {"corners", counts.corners},
            {"total", counts.total()}}},
          {"geometric", geometric_json(report.geometric)},
          {"size_variation",
           {{"regions", variation.regions},
            {"surfaces", variation.surfaces},
            {"lines", variation.lines},
            {"total", variation.total()}}},
          {"neighbourhoods", report.neighbourhoods},
          {"count_by", report.count_by},
          {"cells", cells},
          {"faults", faults_json(report.faults)},
          {"fault_network",
           {{"faults", network.faults},
            {"contacts", network.contacts},
            {"dying", network.dying},
            {"contact_length_m", network.contact_length_m},
            {"smallest_angle_deg", network.smallest_angle_deg},
            {"orientation_variation", network.orientation_variation}}},
          {"regions", needs}};
}

}  // namespace strataflow
