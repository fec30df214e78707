#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/fitted/correction_library.hpp"

namespace flankwright {
namespace {

/// The shortest text that reads back as the same number.
void append(std::string& text, double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  if (!text.empty()) text += ' ';
  text.append(buffer, end);
}

/// In four digits.
void append_rounded(std::string& text, double value) {
  char buffer[32];
  text += ' ';
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 4).ptr);
}

/// Numbers of a line, empty where one of its words is none.
std::vector<double> numbers_in(std::string_view line) {
  std::vector<double> numbers;
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find(' '));
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return {};
    numbers.push_back(value);
    line.remove_prefix(std::min(line.size(), word.size() + 1));
  }
  return numbers;
}

void append(std::string& text, const ResidualStatistics& residuals) {
  for (const double value : {static_cast<double>(residuals.pairs), residuals.median, residuals.share_95, residuals.worst}) {
    append(text, value);
  }
}

constexpr std::size_t kBeforeCoefficients = 20;

std::optional<CorrectionEntry> entry_in(std::string_view line) {
  const std::vector<double> x = numbers_in(line);
  const auto count = static_cast<std::size_t>(KernelForm::correction().count());
  if (x.size() != kBeforeCoefficients + count + count * (count + 1) / 2) return std::nullopt;
  const auto residuals = [&](std::size_t at) { return ResidualStatistics{0, static_cast<int>(x[at]), x[at + 1], x[at + 2], x[at + 3]}; };
  CorrectionEntry entry;
  entry.gear = {static_cast<int>(x[0]), x[1] * units::deg, x[3], x[2]};
  entry.profile = {{x[4], x[5], x[6]}, x[7] * units::deg};
  if (x[8] != 0 && x[8] != 1) return std::nullopt;
  entry.status = x[8] == 1 ? FitStatus::Converged : FitStatus::IterationLimit;
  entry.iterations = static_cast<int>(x[9]);
  entry.pairs = static_cast<int>(x[10]);
  entry.seconds = x[11];
  entry.fitted = residuals(12);
  entry.unseen = residuals(16);
  auto next = x.begin() + kBeforeCoefficients;
  entry.coefficients.assign(next, next + static_cast<std::ptrdiff_t>(count));
  next += static_cast<std::ptrdiff_t>(count);
  entry.covariance.resize(KernelForm::correction().count(), KernelForm::correction().count());
  for (Eigen::Index i = 0; i < entry.covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) entry.covariance(i, j) = entry.covariance(j, i) = *next++;
  }
  return entry;
}

}  // namespace

std::string to_text(const CorrectionEntry& entry) {
  std::string text;
  // Angles are whole tenths of a degree; the radians' last bits must not show.
  append(text, entry.gear.teeth);
  const auto degrees = [](double angle) { return std::round(angle / units::deg * 1e9) / 1e9; };
  append(text, degrees(entry.gear.helix_angle));
  append(text, entry.gear.profile_shift);
  append(text, entry.gear.relative_face);
  for (const double length : {entry.profile.rack.addendum, entry.profile.rack.dedendum, entry.profile.rack.root_radius}) append(text, length);
  append(text, degrees(entry.profile.pressure_angle));
  append(text, entry.status == FitStatus::Converged ? 1.0 : 0.0);
  append(text, entry.iterations);
  append(text, entry.pairs);
  append(text, std::round(entry.seconds * 10) / 10);
  append(text, entry.fitted);
  append(text, entry.unseen);
  for (const double coefficient : entry.coefficients) append(text, coefficient);
  for (Eigen::Index i = 0; i < entry.covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) append_rounded(text, entry.covariance(i, j));
  }
  return text + '\n';
}

std::vector<CorrectionEntry> entries_in(std::string_view text) {
  std::vector<CorrectionEntry> entries;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (line.empty() || line.front() == '#') continue;
    const std::optional<CorrectionEntry> entry = entry_in(line);
    if (!entry) throw InvalidInput("library", "line " + std::to_string(number), "an entry of a library of fits");
    entries.push_back(*entry);
  }
  return entries;
}

}  // namespace flankwright
