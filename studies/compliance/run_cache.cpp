#include "studies/compliance/run_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string_view>

#include "core/base/error.hpp"
#include "studies/base/results_folder.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

static_assert(std::endian::native == std::endian::little, "stored matrices are little-endian");

constexpr std::string_view magic = "flankwright-run 1 ";

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

std::string hex(std::uint64_t number) { return fmt::format("{:016x}", number); }

std::string encode(const Json& key, const StoredRun& run) {
  Json head{{"key", key}, {"facts", run.facts}, {"matrices", Json::array()}};
  for (const auto& [name, matrix] : run.matrices) {
    head["matrices"].push_back({{"name", name}, {"rows", matrix.rows()}, {"columns", matrix.cols()}});
  }
  std::string text = head.dump() + "\n";
  for (const auto& [name, matrix] : run.matrices) {
    text.append(reinterpret_cast<const char*>(matrix.data()), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  }
  return std::string(magic) + hex(fnv1a(text)) + "\n" + text;
}

/// Why a file cannot be used.
struct Unusable {
  std::string why;
};

StoredRun decode(std::string_view file, const Json& key) {
  const std::size_t line = file.find('\n');
  if (line == std::string_view::npos || !file.starts_with(magic)) throw Unusable{"it is of another kind or version"};
  const std::string_view text = file.substr(line + 1);
  if (file.substr(magic.size(), line - magic.size()) != hex(fnv1a(text))) throw Unusable{"it is damaged"};
  const std::size_t head_end = std::min(text.find('\n'), text.size());
  const Json head = Json::parse(text.substr(0, head_end), nullptr, false);
  if (head.is_discarded()) throw Unusable{"it is damaged"};
  // As text, as the file is named by: what is not given, NaN, is null there.
  if (head.at("key").dump() != key.dump()) throw Unusable{"it belongs to another gear"};
  StoredRun run{head.at("facts"), {}};
  std::string_view rest = text.substr(std::min(head_end + 1, text.size()));
  for (const Json& entry : head.at("matrices")) {
    Eigen::MatrixXd matrix(entry.at("rows").get<Eigen::Index>(), entry.at("columns").get<Eigen::Index>());
    const std::size_t bytes = static_cast<std::size_t>(matrix.size()) * sizeof(double);
    if (bytes > rest.size()) throw Unusable{"it is too short"};
    std::memcpy(matrix.data(), rest.data(), bytes);
    rest.remove_prefix(bytes);
    run.matrices.emplace_back(entry.at("name").get<std::string>(), std::move(matrix));
  }
  return run;
}

/// A folder that the environment names; empty where it does not.
fs::path from_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? fs::path() : fs::path(value);
}

}  // namespace

const Eigen::MatrixXd* StoredRun::find(const std::string& name) const {
  const auto found = std::ranges::find_if(matrices, [&](const auto& entry) { return entry.first == name; });
  return found == matrices.end() ? nullptr : &found->second;
}

fs::path RunCache::default_folder() {
  if (const fs::path own = from_environment("FLANKWRIGHT_CACHE"); !own.empty()) return own;
  if (const fs::path caches = from_environment("XDG_CACHE_HOME"); !caches.empty()) return caches / "flankwright";
  return from_environment("HOME") / ".cache" / "flankwright";
}

fs::path RunCache::file_of(const Json& key) const { return folder_ / (hex(fnv1a(key.dump())) + ".run"); }

std::optional<StoredRun> RunCache::find(const Json& key, std::vector<std::string>& notes) const {
  const fs::path file = file_of(key);
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  const auto unusable = [&](const std::string& why) {
    notes.push_back("the stored finite-element run " + file.string() + " is not used: " + why);
    return std::nullopt;
  };
  try {
    return decode(read_whole(file), key);
  } catch (const Unusable& reason) {
    return unusable(reason.why);
  } catch (const InvalidInput& problem) {
    return unusable("it cannot be read");
  } catch (const Json::exception&) {
    return unusable("it is of another kind or version");
  }
}

bool RunCache::store(const Json& key, const StoredRun& run, std::vector<std::string>& notes) const {
  static std::mutex turns;  // studies that run at the same time may store the same gear
  const std::lock_guard lock(turns);
  try {
    make_folder(folder_);
    write_whole(file_of(key), encode(key, run));
    return true;
  } catch (const InvalidInput& problem) {
    notes.push_back("the finite-element run is not kept for another time: " + std::string(problem.what()));
    return false;
  }
}

}  // namespace flankwright::studies
