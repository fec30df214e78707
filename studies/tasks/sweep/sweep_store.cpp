#include "studies/base/version.hpp"
#include "studies/tasks/sweep/sweep_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "studies/base/results_folder.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

constexpr const char* format_name = "flankwright sweep 1";

constexpr const char* fixed_tables = R"(
CREATE TABLE sweep (key TEXT PRIMARY KEY, value);
CREATE TABLE settings (key TEXT PRIMARY KEY, value TEXT);
CREATE TABLE parameters (path TEXT PRIMARY KEY, unit TEXT, distribution TEXT);
CREATE TABLE outputs (name TEXT PRIMARY KEY, unit TEXT);
)";

/// A name with dots as a column of SQL.
std::string column(const std::string& name) { return "\"" + name + "\""; }

std::string column_list(const std::vector<std::string>& parameters, const std::vector<std::string>& outputs, const char* suffix) {
  std::string list;
  for (const auto* names : {&parameters, &outputs}) {
    for (const std::string& name : *names) list += ", " + column(name) + suffix;
  }
  return list;
}

/// 64 bits of a text that hardly another one shares (FNV-1a).
std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return fmt::format("{:016x}", hash);
}

Shard read_shard(Database& database) {
  Statement shards(database, "SELECT (SELECT value FROM sweep WHERE key = 'shard'), (SELECT value FROM sweep WHERE key = 'shards')");
  shards.next();
  return {shards.integer(0) - 1, shards.integer(1)};
}

void check_is_sweep(Database& database) {
  Statement damage(database, "PRAGMA quick_check(1)");
  damage.next();
  if (damage.text(0) != "ok") database.check(SQLITE_CORRUPT);
  Statement kind(database, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('sweep', 'settings', 'samples')");
  kind.next();
  if (kind.integer(0) != 3) database.refuse("a folder for this sweep alone; the file is no store of a sweep and was left as it is");
}

}  // namespace

std::vector<GivenValue> deciding_settings(const Study& study) {
  std::map<std::string, std::string> settings{{"version", version()}};
  const bool extends = study.sweep.sampler == Sampler::Sobol || study.sweep.sampler == Sampler::MonteCarlo;
  for (const GivenValue& given : study.given) {
    const bool is_free = given.key == "title" || given.key.starts_with("expect.") || (extends && given.key == "sweep.samples");
    if (!is_free) settings.emplace(given.key, given.value);
  }
  const auto add_file = [&](const std::string& key, const std::string& file) {
    if (!file.empty()) settings.emplace("contents of " + key, fingerprint(read_whole(fs::path(study.file).parent_path() / file)));
  };
  add_file("pinion.modification.grid", study.grid.pinion.file);
  add_file("wheel.modification.grid", study.grid.wheel.file);
  for (const auto& [gear, files] : {std::pair{"pinion", &study.tooth_grids.pinion}, std::pair{"wheel", &study.tooth_grids.wheel}}) {
    for (std::size_t k = 0; k < files->size(); ++k) add_file(fmt::format("{}.error.grids.{}", gear, k), (*files)[k]);
  }
  std::vector<GivenValue> list;
  for (const auto& [key, value] : settings) list.push_back({key, value});
  return list;
}

SweepStore::SweepStore(const fs::path& file, const Study& study, const std::vector<SweepOutput>& outputs, Shard shard) : database_(file) {
  for (const SweepParameter& p : study.sweep.parameters) parameter_columns_.push_back(p.path);
  for (const SweepOutput& o : outputs) output_columns_.push_back(o.name);
  // The lock is taken here and kept until the file is closed; a journal that a killed run left is rolled back by this.
  database_.execute("PRAGMA locking_mode = EXCLUSIVE; PRAGMA synchronous = FULL; BEGIN EXCLUSIVE;");
  bool is_new = false;
  {
    Statement objects(database_, "SELECT count(*) FROM sqlite_master");
    objects.next();
    is_new = objects.integer(0) == 0;
  }
  if (is_new) {
    create(study, shard);
    Statement insert(database_, "INSERT INTO outputs VALUES (?, ?)");
    for (const SweepOutput& o : outputs) insert.row(o.name, o.unit);
  } else {
    check_same(study, shard);
  }
  database_.execute("COMMIT");
  insert_.emplace(
      database_, "INSERT INTO samples VALUES (?, ?" + [&] {
        std::string marks;
        for (std::size_t k = 0; k < parameter_columns_.size() + output_columns_.size(); ++k) marks += ", ?";
        return marks;
      }() + ")");
}

SweepStore::~SweepStore() = default;

void SweepStore::create(const Study& study, Shard shard) {
  database_.execute(fixed_tables);
  database_.execute("CREATE TABLE samples (id INTEGER PRIMARY KEY, failure TEXT" + column_list(parameter_columns_, output_columns_, " REAL") + ")");
  Statement sweep(database_, "INSERT INTO sweep VALUES (?, ?)");
  sweep.row("format", format_name);
  sweep.row("title", study.title);
  sweep.row("shard", shard.index + 1);
  sweep.row("shards", shard.count);
  sweep.row("seconds", 0.0);
  Statement settings(database_, "INSERT INTO settings VALUES (?, ?)");
  for (const GivenValue& g : deciding_settings(study)) settings.row(g.key, g.value);
  Statement parameters(database_, "INSERT INTO parameters VALUES (?, ?, ?)");
  for (const SweepParameter& p : study.sweep.parameters) parameters.row(p.path, p.unit, p.in_words);
}

void SweepStore::check_same(const Study& study, Shard shard) {
  check_is_sweep(database_);
  std::map<std::string, std::string> stored;
  Statement settings(database_, "SELECT key, value FROM settings");
  while (settings.next()) stored[settings.text(0).value_or("")] = settings.text(1).value_or("");
  const auto differs = [&](const std::string& key, const std::string& was, const std::string& is) {
    database_.refuse(
        fmt::format("a folder for this study alone; the store is of a study in which {} is {}, not {}: choose another "
                    "with --out, or move the store away",
                    key, was, is));
  };
  for (const GivenValue& g : deciding_settings(study)) {
    const auto found = stored.find(g.key);
    if (found == stored.end()) differs(g.key, "not given", g.value);
    if (found->second != g.value) differs(g.key, found->second, g.value);
    stored.erase(found);
  }
  if (!stored.empty()) differs(stored.begin()->first, stored.begin()->second, "not given");
  const Shard found = read_shard(database_);
  if (!(found == shard)) {
    differs("the shard", fmt::format("{}/{}", found.index + 1, found.count), fmt::format("{}/{}", shard.index + 1, shard.count));
  }
}

Shard SweepStore::shard_of(const fs::path& file) {
  Database database(file);
  check_is_sweep(database);
  return read_shard(database);
}

void SweepStore::add(const StoredSample& sample) {
  if (!in_batch_) {
    database_.execute("BEGIN");
    in_batch_ = true;
    batch_start_ = std::chrono::steady_clock::now();
  }
  insert_->reset();
  insert_->bind_at(1, sample.id);
  if (sample.result.failure.empty()) {
    insert_->bind_at(2, nullptr);
  } else {
    insert_->bind_at(2, std::string_view(sample.result.failure));
  }
  int column = 2;
  for (const double value : sample.values) insert_->bind_at(++column, value);
  for (std::size_t k = 0; k < output_columns_.size(); ++k) {
    insert_->bind_at(++column, sample.result.failure.empty() ? sample.result.outputs[k] : not_given);
  }
  insert_->next();
  insert_->reset();
}

void SweepStore::commit(double seconds) {
  if (!in_batch_) return;
  Statement(database_, "UPDATE sweep SET value = value + ? WHERE key = 'seconds'").row(seconds);
  database_.execute("COMMIT");
  in_batch_ = false;
}

double SweepStore::seconds() {
  Statement query(database_, "SELECT value FROM sweep WHERE key = 'seconds'");
  query.next();
  return query.number(0);
}

long long SweepStore::count(long long end) {
  Statement query(database_, "SELECT count(*) FROM samples WHERE id < ?");
  query.bind(end);
  query.next();
  return query.integer(0);
}

std::vector<bool> SweepStore::present(long long begin, long long end) {
  std::vector<bool> found(static_cast<std::size_t>(end - begin), false);
  Statement query(database_, "SELECT id FROM samples WHERE id >= ? AND id < ?");
  query.bind(begin, end);
  while (query.next()) found[static_cast<std::size_t>(query.integer(0) - begin)] = true;
  return found;
}

StoredSample SweepStore::sample_at(const Statement& row) const {
  StoredSample sample{row.integer(0), {}, {row.text(1).value_or(""), {}}};
  int column = 1;
  for (std::size_t k = 0; k < parameter_columns_.size(); ++k) sample.values.push_back(row.number(++column));
  if (!sample.result.failure.empty()) return sample;
  for (std::size_t k = 0; k < output_columns_.size(); ++k) sample.result.outputs.push_back(row.number(++column));
  return sample;
}

void SweepStore::for_each(long long end, const std::function<void(const StoredSample&)>& visit) {
  Statement query(database_, "SELECT * FROM samples WHERE id < ? ORDER BY id");
  query.bind(end);
  while (query.next()) visit(sample_at(query));
}

std::optional<StoredSample> SweepStore::find(long long id) {
  Statement query(database_, "SELECT * FROM samples WHERE id = ?");
  query.bind(id);
  if (!query.next()) return std::nullopt;
  return sample_at(query);
}

void SweepStore::for_each_sorted(std::size_t output, long long end, const std::function<void(double)>& visit) {
  const std::string name = column(output_columns_[output]);
  Statement query(database_, "SELECT " + name + " FROM samples WHERE id < ? AND " + name + " IS NOT NULL ORDER BY 1");
  query.bind(end);
  while (query.next()) visit(query.number(0));
}

}  // namespace flankwright::studies
