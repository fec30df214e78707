#include "studies/base/database.hpp"

#include <limits>

#include "core/base/error.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

Database::Database(const fs::path& file, fs::path shown_as) : shown_as_(std::move(shown_as)) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  handle_.reset(opened);
  check(code);
}

void Database::execute(const std::string& sql) { check(sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr)); }

void Database::refuse(const std::string& allowed) const { throw InvalidInput("output folder", shown_as_.string(), allowed); }

void Database::check(int code) const {
  if (code == SQLITE_OK || code == SQLITE_DONE || code == SQLITE_ROW) return;
  const std::string reason = handle_ ? sqlite3_errmsg(handle_.get()) : sqlite3_errstr(code);
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      refuse("a store that no other run is using (" + reason + ")");
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      refuse("an undamaged store; it was left as it is: move it away to start anew (" + reason + ")");
    default:
      refuse("a place that can be written (" + reason + ")");
  }
}

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  sqlite3_stmt* prepared = nullptr;
  database_.check(sqlite3_prepare_v2(database_.handle(), sql.c_str(), -1, &prepared, nullptr));
  statement_.reset(prepared);
}

void Statement::bind_at(int column, std::string_view text) {
  database_.check(sqlite3_bind_text(statement_.get(), column, text.data(), static_cast<int>(text.size()), SQLITE_STATIC));
}
void Statement::bind_at(int column, double number) { database_.check(sqlite3_bind_double(statement_.get(), column, number)); }
void Statement::bind_at(int column, int number) { database_.check(sqlite3_bind_int(statement_.get(), column, number)); }
void Statement::bind_at(int column, long long number) { database_.check(sqlite3_bind_int64(statement_.get(), column, number)); }
void Statement::bind_at(int column, std::nullptr_t) { database_.check(sqlite3_bind_null(statement_.get(), column)); }

bool Statement::next() {
  const int code = sqlite3_step(statement_.get());
  database_.check(code);
  return code == SQLITE_ROW;
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

std::optional<std::string> Statement::text(int column) const {
  const unsigned char* found = sqlite3_column_text(statement_.get(), column);
  if (found == nullptr) return std::nullopt;
  return std::string(reinterpret_cast<const char*>(found), static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)));
}

double Statement::number(int column) const {
  const bool is_null = sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
  return is_null ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(statement_.get(), column);
}

long long Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

}  // namespace flankwright::studies
