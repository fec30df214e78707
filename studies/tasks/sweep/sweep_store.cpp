#include "studies/base/version.hpp"
#include "core/gear/both_gears.hpp"
#include "studies/tasks/sweep/sweep_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "studies/base/results_folder.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

constexpr const char* format_name = "flankwright sweep 2";

constexpr const char* fixed_tables = R"(
CREATE TABLE sweep (key TEXT PRIMARY KEY, value);
CREATE TABLE settings (key TEXT PRIMARY KEY, value TEXT);
CREATE TABLE parameters (path TEXT PRIMARY KEY, unit TEXT, distribution TEXT);
CREATE TABLE outputs (name TEXT PRIMARY KEY, unit TEXT);
CREATE TABLE batches (id INTEGER PRIMARY KEY, samples INTEGER, seconds REAL, checksum INTEGER);
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

/// 64 bits of what is added that hardly anything else shares (FNV-1a). One changed bit always changes them.
class Fingerprint {
 public:
  Fingerprint& add(std::string_view bytes) {
    for (const char c : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    return *this;
  }
  Fingerprint& add(std::uint64_t word) {
    for (int k = 0; k < 8; ++k) hash_ = (hash_ ^ (word >> (8 * k) & 0xffU)) * 0x100000001b3ULL;
    return *this;
  }
  /// As SQLite gives it back: one NaN, one zero.
  Fingerprint& add(double number) {
    return add(std::bit_cast<std::uint64_t>(std::isnan(number) ? std::numeric_limits<double>::quiet_NaN() : number + 0.0));
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_{0xcbf29ce484222325ULL};
};

std::uint64_t fingerprint_of(const StoredSample& sample) {
  Fingerprint print;
  print.add(static_cast<std::uint64_t>(sample.id)).add(sample.result.failure).add(static_cast<std::uint64_t>(sample.result.failure.size()));
  for (const double value : sample.values) print.add(value);
  for (const double output : sample.result.outputs) print.add(output);
  return print.value();
}

/// Of what never changes: every table but those of samples and batches, and the names of all columns.
std::uint64_t fingerprint_of_head(Database& database) {
  Fingerprint print;
  for (const char* sql : {"SELECT key, value FROM sweep WHERE key <> 'checksum' ORDER BY key", "SELECT key, value FROM settings ORDER BY key",
                          "SELECT path, unit || distribution FROM parameters ORDER BY path", "SELECT name, unit FROM outputs ORDER BY name",
                          "SELECT name, sql FROM sqlite_master ORDER BY name"}) {
    Statement rows(database, sql);
    while (rows.next()) {
      for (const int k : {0, 1}) {
        const std::string text = rows.text(k).value_or("");
        print.add(text).add(static_cast<std::uint64_t>(text.size()));
      }
    }
  }
  return print.value();
}

Shard read_shard(Database& database) {
  Statement shards(database, "SELECT (SELECT value FROM sweep WHERE key = 'shard'), (SELECT value FROM sweep WHERE key = 'shards')");
  shards.next();
  return {shards.integer(0) - 1, shards.integer(1)};
}

[[noreturn]] void refuse_damaged(const Database& database, const std::string& part) {
  database.refuse(fmt::format("an undamaged store; it was left as it is: move it away to start anew ({} are not what was written: checksum)", part));
}

void check_is_sweep(Database& database) {
  Statement damage(database, "PRAGMA integrity_check(1)");
  damage.next();
  if (damage.text(0) != "ok") database.check(SQLITE_CORRUPT);
  Statement kind(database, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('sweep', 'settings', 'samples')");
  kind.next();
  if (kind.integer(0) != 3) database.refuse("a folder for this sweep alone; the file is no store of a sweep and was left as it is");
  const auto of_sweep = [&](const char* key) {
    Statement query(database, "SELECT value FROM sweep WHERE key = ?");
    query.bind(std::string_view(key));
    return query.next() ? query.text(0).value_or("") : "";
  };
  if (const std::string format = of_sweep("format"); format != format_name) {
    database.refuse(fmt::format("a store of the format \"{}\", not \"{}\": move it away to start anew", format_name, format));
  }
  if (of_sweep("checksum") != std::to_string(static_cast<std::int64_t>(fingerprint_of_head(database)))) refuse_damaged(database, "its settings");
}

}  // namespace

std::vector<GivenValue> deciding_settings(const Study& study) {
  const auto contents_of = [](const fs::path& file) { return fmt::format("{:016x}", Fingerprint().add(read_whole(file)).value()); };
  std::map<std::string, std::string> settings{{"version", version()}};
  const bool extends = study.table<SweepTable>().sampler == Sampler::Sobol || study.table<SweepTable>().sampler == Sampler::MonteCarlo;
  for (const GivenValue& given : study.given) {
    const bool is_free = given.key == "title" || given.key.starts_with("expect.") || (extends && given.key == "sweep.samples");
    if (!is_free) settings.emplace(given.key, given.value);
  }
  const auto add_file = [&](const std::string& key, const std::string& file) {
    if (!file.empty()) settings.emplace("contents of " + key, contents_of(fs::path(study.file).parent_path() / file));
  };
  for (const Member m : both_gears) {
    add_file(name_of(m) + std::string(".modification.grid"), study.grid[m].file);
    add_file(name_of(m) + std::string(".modification.grid_of_opposite_flank"), study.opposite_grid[m].file);
  }
  add_file("load.spectrum.file", study.spectrum_source.file);
  add_file("load.spectrum.signal", study.spectrum_source.signal);
  for (const auto& [gear, files] : {std::pair{"pinion", &study.tooth_grids.pinion}, std::pair{"wheel", &study.tooth_grids.wheel}}) {
    for (std::size_t k = 0; k < files->size(); ++k) add_file(fmt::format("{}.error.grids.{}", gear, k), (*files)[k]);
  }
  std::vector<GivenValue> list;
  for (const auto& [key, value] : settings) list.push_back({key, value});
  return list;
}

SweepStore::SweepStore(const fs::path& file, const Study& study, const std::vector<SweepOutput>& outputs, Shard shard) : database_(file) {
  for (const SweepParameter& p : study.table<SweepTable>().parameters) parameter_columns_.push_back(p.path);
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
    Statement(database_, "INSERT INTO sweep VALUES ('checksum', ?)").row(static_cast<long long>(fingerprint_of_head(database_)));
  } else {
    check_same(study, shard);
    check_samples();
  }
  database_.execute("COMMIT");
  insert_.emplace(
      database_, "INSERT INTO samples VALUES (?, ?, ?" + [&] {
        std::string marks;
        for (std::size_t k = 0; k < parameter_columns_.size() + output_columns_.size(); ++k) marks += ", ?";
        return marks;
      }() + ")");
}

SweepStore::~SweepStore() = default;

void SweepStore::create(const Study& study, Shard shard) {
  database_.execute(fixed_tables);
  database_.execute("CREATE TABLE samples (id INTEGER PRIMARY KEY, batch INTEGER, failure TEXT" +
                    column_list(parameter_columns_, output_columns_, " REAL") + ")");
  Statement sweep(database_, "INSERT INTO sweep VALUES (?, ?)");
  sweep.row("format", format_name);
  sweep.row("title", study.title);
  sweep.row("shard", shard.index + 1);
  sweep.row("shards", shard.count);
  Statement settings(database_, "INSERT INTO settings VALUES (?, ?)");
  for (const GivenValue& g : deciding_settings(study)) settings.row(g.key, g.value);
  Statement parameters(database_, "INSERT INTO parameters VALUES (?, ?, ?)");
  for (const SweepParameter& p : study.table<SweepTable>().parameters) parameters.row(p.path, p.unit, p.in_words);
}

void SweepStore::check_same(const Study& study, Shard shard) {
  check_is_sweep(database_);
  std::map<std::string, std::string> stored;
  Statement settings(database_, "SELECT key, value FROM settings");
  while (settings.next()) stored[settings.text(0).value_or("")] = settings.text(1).value_or("");
  const auto differs = [&](const std::string& key, const std::string& was, const std::string& is) {
    database_.refuse(
        fmt::format("a folder for this study alone; {} is {} in the study of the store and {} here: choose another folder "
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

void SweepStore::check_samples() {
  std::map<long long, Batch> found;
  Statement rows(database_, "SELECT * FROM samples");
  while (rows.next()) found[rows.integer(1)].add(fingerprint_of(sample_at(rows)));
  Statement batches(database_, "SELECT id, samples, seconds, checksum FROM batches");
  while (batches.next()) {
    const auto batch = found.find(batches.integer(0));
    const bool is_whole = batch != found.end() && batch->second.samples == batches.integer(1) &&
                          batch->second.checksum(batches.integer(0), batches.number(2)) == batches.integer(3);
    if (!is_whole) refuse_damaged(database_, fmt::format("the samples of batch {}", batches.integer(0)));
    found.erase(batch);
  }
  if (!found.empty()) refuse_damaged(database_, fmt::format("the samples of batch {}", found.begin()->first));
}

long long SweepStore::Batch::checksum(long long id, double seconds) const {
  return std::bit_cast<std::int64_t>(Fingerprint().add(sum).add(static_cast<std::uint64_t>(id)).add(seconds).value());
}

Shard SweepStore::shard_of(const fs::path& file) {
  Database database(file);
  check_is_sweep(database);
  return read_shard(database);
}

void SweepStore::add(const StoredSample& sample) {
  if (!batch_) {
    Statement last(database_, "SELECT coalesce(max(id), 0) FROM batches");
    last.next();
    batch_id_ = last.integer(0) + 1;
    database_.execute("BEGIN");
    batch_.emplace();
  }
  batch_->add(fingerprint_of(sample));
  insert_->reset();
  insert_->bind_at(1, sample.id);
  insert_->bind_at(2, batch_id_);
  if (sample.result.failure.empty()) {
    insert_->bind_at(3, nullptr);
  } else {
    insert_->bind_at(3, std::string_view(sample.result.failure));
  }
  int column = 3;
  for (const double value : sample.values) insert_->bind_at(++column, value);
  for (std::size_t k = 0; k < output_columns_.size(); ++k) {
    insert_->bind_at(++column, sample.result.failure.empty() ? sample.result.outputs[k] : not_given);
  }
  insert_->next();
  insert_->reset();
}

void SweepStore::commit(double seconds) {
  if (!batch_) return;
  Statement(database_, "INSERT INTO batches VALUES (?, ?, ?, ?)").row(batch_id_, batch_->samples, seconds, batch_->checksum(batch_id_, seconds));
  database_.execute("COMMIT");
  batch_.reset();
}

double SweepStore::seconds() {
  Statement query(database_, "SELECT coalesce(sum(seconds), 0.0) FROM batches");
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
  StoredSample sample{row.integer(0), {}, {row.text(2).value_or(""), {}}};
  int column = 2;
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
