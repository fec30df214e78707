#include "studies/exchange/vtk/vtk_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace flankwright::studies {

namespace {

constexpr int surface_step = 5;  ///< every fifth row and column of the 41 x 41 maps of results.json
constexpr int surface_points = 9;
constexpr double on_line_within = 1e-6;  ///< flanks are drawn where a point of some tooth has off_line() at most this [mm]

/// A number of results.json; NaN for null, as where a mesh position did not converge.
double number(const Json& value) { return value.is_number() ? value.get<double>() : std::nan(""); }

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += at + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 0x3fU];
  }
  return text;
}

/// Numbers as the XML format packs them: their bytes behind the count of these. As text VTK's reader would stop at the first NaN and
/// leave what follows zero, without a word.
template <typename Number>
std::string packed(const std::vector<Number>& numbers) {
  const auto size = static_cast<std::uint32_t>(numbers.size() * sizeof(Number));
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, numbers.data(), size);
  return base64(bytes);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < ' ' || c == '-' ? ' ' : c;  // two hyphens would end a comment
  }
  return out;
}

/// PolyData as it grows: points, their fields, and cells of either lines or quadrilaterals.
class PolyData {
 public:
  explicit PolyData(std::vector<std::string> fields) : fields_(std::move(fields)), values_(fields_.size()) {}

  int add_point(double x, double y, double z, const std::vector<double>& values) {
    points_.insert(points_.end(), {x, y, z});
    for (std::size_t i = 0; i < values.size(); ++i) values_[i].push_back(values[i]);
    return count_++;
  }
  void add_cell(const std::vector<int>& corners, int tooth) {
    connectivity_.insert(connectivity_.end(), corners.begin(), corners.end());
    offsets_.push_back(static_cast<std::int32_t>(connectivity_.size()));
    teeth_.push_back(tooth);
  }

  std::string text(const char* cell_kind, const std::string& comment) const {
    std::string xml = "<?xml version=\"1.0\"?>\n<!-- " + escaped(comment) + " -->\n";
    xml += fmt::format("<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt32\">\n<PolyData>\n",
                       std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    const bool lines = std::string_view(cell_kind) == "Lines";
    xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n", count_,
                       lines ? teeth_.size() : 0, lines ? 0 : teeth_.size());
    xml += "<PointData>\n";
    for (std::size_t i = 0; i < fields_.size(); ++i) xml += array(fields_[i], values_[i]);
    xml += "</PointData>\n<CellData>\n" + array("tooth", teeth_) + "</CellData>\n<Points>\n" + array("position_mm", points_, 3) + "</Points>\n";
    xml += fmt::format("<{}>\n{}{}</{}>\n", cell_kind, array("connectivity", connectivity_), array("offsets", offsets_), cell_kind);
    return xml + "</Piece>\n</PolyData>\n</VTKFile>\n";
  }

 private:
  template <typename Number>
  static std::string array(const std::string& name, const std::vector<Number>& values, int components = 1) {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                       std::is_same_v<Number, double> ? "Float64" : "Int32", name, components, packed(values));
  }

  std::vector<std::string> fields_;
  std::vector<std::vector<double>> values_;  ///< of each field, one a point
  std::vector<double> points_;               ///< x, y, z of each
  std::vector<std::int32_t> connectivity_, offsets_, teeth_;
  int count_{0};
};

/// What of results.json places points in the housing.
struct MeshFrame {
  double pressure_angle;                  ///< alpha_wt [rad]
  double pitch_radius;                    ///< of the pinion, working [mm]
  double lead;                            ///< roll length of the pinion's contact line per mm of z, signed
  double path;                            ///< T1 T2 [mm]
  double base_pitch;                      ///< transverse [mm]
  double centre_distance;                 ///< [mm]
  std::array<double, 2> base, root, tip;  ///< radii of pinion and wheel, of the flank that may touch: active root and tip form [mm]
  std::array<double, 2> half_face;        ///< [mm]
  std::array<double, 2> mid_face;         ///< z of it [mm]
  std::string flank;                      ///< that works: "right" or "left"
  double mirror;                          ///< -1: the left one

  /// @param loaded  the load case
  MeshFrame(const Json& json, const Json& loaded) {
    const Json& geometry = json.at("geometry");
    const Json& used = json.at("used").at("pair");
    pressure_angle = geometry.at("working_transverse_pressure_angle_deg").get<double>() * units::deg;
    pitch_radius = 0.5 * geometry.at("pinion").at("working_pitch_diameter_mm").get<double>();
    path = geometry.at("path_of_contact_mm").at("T1_T2");
    base_pitch = geometry.at("transverse_base_pitch_mm");
    centre_distance = geometry.at("centre_distance_mm");
    flank = loaded.value("working_flank", used.at("working_flank").get<std::string>());
    mirror = flank == "right" ? 1.0 : -1.0;
    const double hand = geometry.at("pinion").at("hand") == "right" ? 1.0 : -1.0;
    lead = mirror * hand * std::tan(geometry.at("base_helix_angle_deg").get<double>() * units::deg);
    for (const std::size_t g : {0U, 1U}) {
      const Json& gear = geometry.at(g == 0U ? "pinion" : "wheel");
      base[g] = 0.5 * gear.at("base_diameter_mm").get<double>();
      root[g] = 0.5 * gear.at("active_root_diameter_mm").get<double>();
      tip[g] = 0.5 * gear.at("tip_form_diameter_mm").get<double>();
      half_face[g] = 0.5 * used.at(g == 0U ? "pinion" : "wheel").at("face_width_mm").get<double>();
      mid_face[g] = g == 0U ? 0.0 : loaded.value("axial_offset_mm", 0.0);
    }
  }

  double roll(std::size_t gear, double radius) const { return std::sqrt(std::max(0.0, (radius - base[gear]) * (radius + base[gear]))); }

  /// How far a contact point is from the line of action [mm]: there both roll lengths make up the path.
  double off_line(const Json& point) const { return std::abs(roll(0, point.at("pinion_radius_mm")) + roll(1, point.at("wheel_radius_mm")) - path); }

  /// Where the point's radii on both gears meet: on the line of action, or beside it where a tip edge touches.
  std::array<double, 2> place(const Json& point) const {
    const double r1 = point.at("pinion_radius_mm"), r2 = point.at("wheel_radius_mm"), a = centre_distance;
    const double x = (r1 * r1 - r2 * r2 + a * a) / (2.0 * a), y = std::sqrt(std::max(0.0, r1 * r1 - x * x));
    return {x, x < pitch_radius ? -mirror * y : mirror * y};
  }

  /// The involute of a gear at roll length rho, whose contact line is at `contact` in this section: base tangent point turned on from
  /// the line of action by the difference.
  std::array<double, 2> place(std::size_t gear, double rho, double contact) const {
    const double angle = -pressure_angle + (contact - rho) / base[gear];
    const double x = base[gear] * std::cos(angle) - rho * std::sin(angle), y = base[gear] * std::sin(angle) + rho * std::cos(angle);
    return gear == 0U ? std::array{x, mirror * y} : std::array{centre_distance - x, -mirror * y};
  }
};

const std::vector<std::pair<const char*, const char*>> point_fields{
    {"load_N_per_mm", "load_N_per_mm"}, {"contact_stress_MPa", "contact_stress_MPa"},       {"gap_um", "gap_um"},
    {"error_um", "error_um"},           {"contact_deflection_um", "contact_deflection_um"}, {"structural_deflection_um", "structural_deflection_um"},
    {"radius_mm", "pinion_radius_mm"}};

PolyData contact_lines(const MeshFrame& frame, const Json& position) {
  std::vector<std::string> names;
  for (const auto& [name, key] : point_fields) names.emplace_back(name);
  PolyData data(std::move(names));
  for (const Json& tooth : position.at("teeth")) {
    std::vector<int> line;
    for (const Json& point : tooth.at("points")) {
      const auto [x, y] = frame.place(point);
      std::vector<double> values;
      for (const auto& [name, key] : point_fields) values.push_back(number(point.at(key)));
      line.push_back(data.add_point(x, y, point.at("z_mm"), values));
    }
    if (line.size() > 1) data.add_cell(line, tooth.at("tooth"));
  }
  return data;
}

/// The map of what is removed from a gear's flank in a design, from the active root to the tip form radius; null where it is unmodified.
const Json* removal_map(const Json& json, std::size_t gear, const std::string& flank, const std::string& design) {
  for (const Json& map : json.at("modifications")) {
    if (map.at("gear") == (gear == 0U ? "pinion" : "wheel") && map.at("flank") == flank && map.at("design") == design) return &map;
  }
  return nullptr;
}

/// Roll length of the pinion's contact line of tooth 0 at mid face [mm], by the point of all teeth that lies closest to the line of
/// action; NaN where tip edges alone touch.
double roll_at_mid(const MeshFrame& frame, const Json& position) {
  double at_mid = std::numeric_limits<double>::quiet_NaN(), off = on_line_within;
  for (const Json& tooth : position.at("teeth")) {
    for (const Json& point : tooth.at("points")) {
      if (frame.off_line(point) > off) continue;
      off = frame.off_line(point);
      at_mid =
          frame.roll(0, point.at("pinion_radius_mm")) - frame.lead * point.at("z_mm").get<double>() - tooth.at("tooth").get<int>() * frame.base_pitch;
    }
  }
  return at_mid;
}

PolyData flanks(const MeshFrame& frame, const Json& position, std::size_t gear, const Json* removal) {
  PolyData data({"removal_um", "radius_mm"});
  const double at_mid = roll_at_mid(frame, position);
  if (std::isnan(at_mid)) return data;
  for (const Json& tooth : position.at("teeth")) {
    if (tooth.at("points").empty()) continue;
    std::vector<int> before;
    for (int i = 0; i < surface_points; ++i) {
      std::vector<int> row;
      const double radius = std::lerp(frame.root[gear], frame.tip[gear], static_cast<double>(i) / (surface_points - 1));
      for (int j = 0; j < surface_points; ++j) {
        const double z =
            frame.mid_face[gear] + std::lerp(-frame.half_face[gear], frame.half_face[gear], static_cast<double>(j) / (surface_points - 1));
        const double of_pinion = at_mid + tooth.at("tooth").get<int>() * frame.base_pitch + frame.lead * z;
        const auto [x, y] = frame.place(gear, frame.roll(gear, radius), gear == 0U ? of_pinion : frame.path - of_pinion);
        const auto row_of_map = static_cast<std::size_t>(i * surface_step), column = static_cast<std::size_t>(j * surface_step);
        const double removed = removal == nullptr ? 0.0 : number(removal->at("removal_um").at(row_of_map).at(column));
        row.push_back(data.add_point(x, y, z, {removed, radius}));
      }
      for (std::size_t j = 0; i > 0 && j + 1 < row.size(); ++j) {  // in the order by which normals point out of the tooth
        std::vector<int> corners{before[j], before[j + 1], row[j + 1], row[j]};
        if (frame.mirror < 0.0) std::ranges::reverse(corners);
        data.add_cell(corners, tooth.at("tooth"));
      }
      before = std::move(row);
    }
  }
  return data;
}

void add_case(const Json& json, std::size_t index, std::vector<NamedText>& files) {
  const Json& loaded = json.at("loaded").at(index);
  const MeshFrame frame(json, loaded);
  const std::string name = fmt::format("contact-{}", index + 1), design = loaded.at("design");
  const std::string comment = fmt::format("{}, {} N m, {}", loaded.at("scene").get<std::string>(), loaded.at("torque_Nm").get<double>(), design);
  std::string collection = "<?xml version=\"1.0\"?>\n<!-- " + escaped(comment) +
                           " -->\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  std::size_t k = 0;
  for (const Json& position : loaded.at("cycle")) {
    const std::array<std::pair<const char*, std::string>, 3> parts{
        {{"lines", contact_lines(frame, position).text("Lines", comment)},
         {"pinion", flanks(frame, position, 0, removal_map(json, 0, frame.flank, design)).text("Polys", comment)},
         {"wheel", flanks(frame, position, 1, removal_map(json, 1, frame.flank, design)).text("Polys", comment)}}};
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const std::string file = fmt::format("{}/{}-{:04}.vtp", name, parts[part].first, k);
      collection += fmt::format("<DataSet timestep=\"{:.9g}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", number(position.at("phase")), part, file);
      files.push_back({file, parts[part].second});
    }
    ++k;
  }
  files.push_back({name + ".pvd", collection + "</Collection>\n</VTKFile>\n"});
}

}  // namespace

std::vector<NamedText> vtk_series(const Json& results, const std::string& file) {
  std::vector<NamedText> files;
  try {
    if (results.at("loaded").empty()) throw InvalidInput(file, "no loaded contact", "results of a study with a torque");
    for (std::size_t i = 0; i < results.at("loaded").size(); ++i) add_case(results, i, files);
  } catch (const Json::exception&) {
    throw InvalidInput(file, damaged_results, results_of_a_run);
  }
  return files;
}

}  // namespace flankwright::studies
