#include "studies/study_file/key_rows.hpp"

namespace flankwright::studies {

namespace {

GearBody& body(StudyBuilder& builder, Member m) { return builder.study.body[m]; }

/// Rim, web and hub, made by the first of their keys.
WebbedBody& web(StudyBuilder& builder, Member m) {
  std::optional<WebbedBody>& of_gear = body(builder, m).web;
  if (!of_gear) of_gear.emplace();
  return *of_gear;
}

using enum ValueKind;

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> body_rows() {
  return {
      {.path = "gear.body.hold", .kind = Word, .words = {"shaft", "rigid_bore"}, .fallback = "(\"shaft\")",
       .meaning = "shaft: an elastic shaft runs through the gear and is one piece with it, as a gear cut on its shaft or shrunk onto it; "
                  "rigid_bore: no shaft, the surface of the gear's bore neither yields nor moves; compliances \"fitted\" and \"fe\" and task \"fit\"",
       .store = [](StudyBuilder& d, Member m, const Value& v) { body(d, m).hold = v.integer == 0 ? BodyHold::Shaft : BodyHold::RigidBore; }},
      {.path = "gear.body.shaft_diameter", .quantity = Quantity::Length, .range = any_length,
       .fallback = "(0.8 d, at most 25 m_n/cos(beta) and d_f - 1.2 m_n)",
       .meaning = "of the shaft that the gear is one with; at most d_f - m_n; not with hold = \"rigid_bore\"; compliances \"fitted\" and \"fe\" and task \"fit\"",
       .store = [](StudyBuilder& d, Member m, const Value& v) { body(d, m).shaft_diameter = v.number; }},
      {.path = "gear.body.bore_diameter", .quantity = Quantity::Length, .range = any_length,
       .fallback = "(0.05 of the shaft; of a held bore the default of shaft_diameter)",
       .meaning = "of the shaft, below 0.9 of it; with hold = \"rigid_bore\" of the gear, at most d_f - m_n; compliances \"fitted\" and \"fe\" and task \"fit\"",
       .store = [](StudyBuilder& d, Member m, const Value& v) { body(d, m).bore_diameter = v.number; }},
      {.path = "gear.body.shaft_overhang", .quantity = Quantity::Length, .range = any_length,
       .fallback = "(0.5 of the shaft)",
       .meaning = "length of the shaft beyond each end of face or hub, whichever is wider; not with hold = \"rigid_bore\"; compliances \"fitted\" and \"fe\" and task \"fit\"",
       .store = [](StudyBuilder& d, Member m, const Value& v) { body(d, m).shaft_overhang = v.number; }},
      {.path = "gear.body.rim_thickness", .quantity = Quantity::Length, .range = any_length, .fallback = "(none: a solid disc)",
       .meaning = "from the root circle to the underside of a rim as wide as the face, at least 0.5 m_n; with it the gear has rim, web and hub, and needs web_thickness",
       .store = [](StudyBuilder& d, Member m, const Value& v) { web(d, m).rim_thickness = v.number; }},
      {.path = "gear.body.web_thickness", .quantity = Quantity::Length, .range = any_length, .fallback = "(none: a solid disc)",
       .meaning = "along the axis, from 0.1 m_n to the face width or the hub's; needs rim_thickness",
       .store = [](StudyBuilder& d, Member m, const Value& v) { web(d, m).web_thickness = v.number; }},
      {.path = "gear.body.web_offset", .quantity = Quantity::Length, .range = within(10000.0), .fallback = "(0)",
       .meaning = "of the web's middle from mid face, + towards +z; the web may leave neither rim nor hub",
       .store = [](StudyBuilder& d, Member m, const Value& v) { web(d, m).web_offset = v.number; }},
      {.path = "gear.body.hub_diameter", .quantity = Quantity::Length, .range = any_length, .fallback = "(1.5 of the shaft, or of the held bore)",
       .meaning = "outer, at least 1.05 of the shaft or the held bore; leaves a module of web",
       .store = [](StudyBuilder& d, Member m, const Value& v) { web(d, m).hub_diameter = v.number; }},
      {.path = "gear.body.hub_width", .quantity = Quantity::Length, .range = any_length, .fallback = "(the face width)",
       .meaning = "along the axis, its middle at mid face",
       .store = [](StudyBuilder& d, Member m, const Value& v) { web(d, m).hub_width = v.number; }},
      {.path = "gear.body.hole_count", .kind = Integer, .range = {.low = 0, .high = 1000}, .fallback = "(0)",
       .meaning = "holes through the web, 0 or at least 3, evenly spaced; between d_c - d_h and d_c + d_h they leave (1 - n d_h/(4 d_c))^3 of its modulus",
       .store = [](StudyBuilder& d, Member m, const Value& v) { web(d, m).holes.count = static_cast<int>(v.integer); }},
      {.path = "gear.body.hole_diameter", .quantity = Quantity::Length, .range = any_length, .fallback = "(none; holes need it)",
       .meaning = "d_h, within the web",
       .store = [](StudyBuilder& d, Member m, const Value& v) { web(d, m).holes.diameter = v.number; }},
      {.path = "gear.body.hole_circle_diameter", .quantity = Quantity::Length, .range = any_length, .fallback = "(midway between hub and rim)",
       .meaning = "d_c, of the circle that the holes' centres lie on",
       .store = [](StudyBuilder& d, Member m, const Value& v) { web(d, m).holes.circle_diameter = v.number; }},
  };
}

// clang-format on

}  // namespace flankwright::studies
