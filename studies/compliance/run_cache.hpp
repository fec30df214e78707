#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// The stored part of a finite-element run.
struct StoredRun {
  Json facts;                                                     ///< its times and sizes
  std::vector<std::pair<std::string, Eigen::MatrixXd>> matrices;  ///< under their names

  /// nullptr where there is none of that name.
  const Eigen::MatrixXd* find(const std::string& name) const;
};

/// Finite-element runs kept in a folder, each in a file named by the hash of its key: everything that defines the run.
///
/// A file is three parts: a line "flankwright-run 1 CHECKSUM", a line of JSON with key, facts, and the names and sizes
/// of the matrices, and these, column by column, as little-endian doubles. The checksum (FNV-1a, 64 bit) is that of all
/// that follows its line; that and the whole key must agree, so that neither a damaged file nor a hash that two keys
/// share does harm. Problems of the disk do not throw: they give a note, and the run is made anew.
class RunCache {
 public:
  explicit RunCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// $FLANKWRIGHT_CACHE, or else $XDG_CACHE_HOME/flankwright, or else ~/.cache/flankwright.
  static std::filesystem::path default_folder();

  std::filesystem::path file_of(const Json& key) const;

  /// The run of that key; nullopt where there is none that can be used, with a note where there is one that cannot.
  std::optional<StoredRun> find(const Json& key, std::vector<std::string>& notes) const;

  /// Keeps a run; the file appears whole or not at all. False, with a note, where it cannot be written.
  bool store(const Json& key, const StoredRun& run, std::vector<std::string>& notes) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace flankwright::studies
