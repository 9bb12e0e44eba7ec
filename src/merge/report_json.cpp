// The report as JSON: the fields of struct Report under their own names.
#include <nlohmann/json.hpp>

#include "meshgraft/report.hpp"

namespace meshgraft {
namespace {

using Json = nlohmann::ordered_json;

Json json(Vec3 p) { return Json::array({p.x, p.y, p.z}); }

Json json(const InputSummary& s) {
  return {{"path", s.path},    {"sha256", s.sha256},     {"bytes", s.bytes},
          {"nodes", s.nodes},  {"elements", s.elements}, {"elements_by_kind", s.elements_by_kind},
          {"groups", s.groups}};
}

Json json(const PolylineSummary& p) {
  return {{"kind", p.kind},       {"closed", p.closed}, {"length", p.length},        {"nodes", p.nodes},
          {"corners", p.corners}, {"inputs", p.inputs}, {"components", p.components}};
}

Json json(const OverlapEntry& o) {
  return {{"rule", o.rule},   {"inputs", o.inputs}, {"components", o.components},
          {"faces", o.faces}, {"area", o.area},     {"at", json(o.at)}};
}

Json json(const ComponentSummary& c) {
  return {{"input", c.input}, {"faces", c.faces}, {"element", c.element}, {"groups", c.groups}};
}

Json json(const QualityPlace& p) {
  return {{"q", p.q}, {"at", json(p.at)}, {"element", p.element}, {"cause", p.cause}};
}

Json json(const GroupEntry& g) {
  return {{"name", g.name},
          {"kind", g.kind},
          {"members_before", g.members_before},
          {"members_after", g.members_after},
          {"area_before", g.area_before},
          {"area_after", g.area_after},
          {"length_before", g.length_before},
          {"length_after", g.length_after},
          {"rule", g.rule}};
}

Json json(const DroppedEntry& d) {
  return {{"input", d.input}, {"cause", d.cause}, {"faces", d.faces},
          {"area", d.area},   {"at", json(d.at)}, {"groups", d.groups}};
}

Json json(const LabelShift& s) { return {{"input", s.input}, {"kind", s.kind}, {"from", s.from}, {"to", s.to}}; }

Json json(const MovedEntry& m) {
  return {{"input", m.input}, {"node", m.node}, {"from", json(m.from)}, {"to", json(m.to)}, {"distance", m.distance}};
}

Json json(const DatasetEntry& d) {
  return {{"input", d.input}, {"number", d.number}, {"line", d.line}, {"bytes", d.bytes}, {"fate", d.fate}};
}

Json json(const Place& p) { return {{"file", p.file}, {"line", p.line}}; }

Json json(const Warning& w) { return {{"name", w.name}, {"what", w.what}, {"place", json(w.place)}}; }

Json json(const Error& e) {
  return {{"name", name(e.code)}, {"what", e.what}, {"hint", e.hint}, {"place", json(e.place)}};
}

template <class T>
Json list(const std::vector<T>& items) {
  Json all = Json::array();
  for (const T& item : items) all.push_back(json(item));
  return all;
}

Json json(const QualitySummary& q) {
  return {{"faces", q.faces}, {"min", q.min},     {"p01", q.p01},
          {"mean", q.mean},   {"below", q.below}, {"worst", list(q.worst)}};
}

Json json(const Report::Zone& z) {
  return {{"faces_removed", z.faces_removed}, {"faces_created", z.faces_created}, {"nodes_removed", z.nodes_removed},
          {"nodes_created", z.nodes_created}, {"bandwidth", z.bandwidth},         {"widened", z.widened}};
}

/// Null in each field where nothing was measured.
Json json(const std::optional<Report::Fidelity>& f) {
  const auto figures = [&](const auto& of) {
    return Json{{"max_distance", f ? Json(of.max_distance) : Json()},
                {"max_distance_relative", f ? Json(of.max_distance_relative) : Json()},
                {"at", f ? json(of.at) : Json()}};
  };
  const Report::Fidelity nothing;
  Json all = figures(f.value_or(nothing));
  all["removed"] = figures(f.value_or(nothing).removed);
  return all;
}

Json json(const std::vector<std::pair<std::string, double>>& timings) {
  Json all = Json::object();
  for (const auto& [stage, seconds] : timings) all[stage] = seconds;
  return all;
}

}  // namespace

std::string to_json(const Report& r) {
  Json all;
  all["version"] = r.version;
  all["inputs"] = list(r.inputs);
  all["components"] = list(r.components);
  all["junction"] = list(r.junction);
  all["overlaps"] = list(r.overlaps);
  all["zone"] = json(r.zone);
  all["quality"] = json(r.quality);
  all["fidelity"] = json(r.fidelity);
  all["groups"] = list(r.groups);
  all["untouched"] = {{"nodes", r.untouched.nodes}, {"elements", r.untouched.elements}, {"bytes", r.untouched.bytes}};
  all["dropped"] = list(r.dropped);
  all["labels"] = list(r.labels);
  all["removed_nodes"] = r.removed_nodes;
  all["removed_elements"] = r.removed_elements;
  all["moved"] = list(r.moved);
  all["datasets"] = list(r.datasets);
  all["timings"] = json(r.timings);
  all["peak_memory_bytes"] = r.peak_memory_bytes;
  all["warnings"] = list(r.warnings);
  all["broken_promises"] = list(r.broken_promises);
  // Names in files are bytes of any encoding; what is not UTF-8 is replaced, as JSON cannot hold it.
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace meshgraft
