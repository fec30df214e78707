#pragma once

#include <sqlite3.h>

#include <cassert>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace flankwright::studies {

/// An open SQLite database; closed when it goes. What fails throws InvalidInput, field "output folder", which names the file and says in one
/// line whether it is in use, damaged, or cannot be written.
class Database {
 public:
  /// Opens a file, made where there is none.
  /// @param shown_as  the file that messages name
  Database(const std::filesystem::path& file, std::filesystem::path shown_as);
  explicit Database(const std::filesystem::path& file) : Database(file, file) {}

  void execute(const std::string& sql);

  /// Throws unless the code says that all is well.
  void check(int code) const;
  [[noreturn]] void refuse(const std::string& allowed) const;

  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };
  std::filesystem::path shown_as_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// One statement, used time after time: row() for what gives nothing back, bind() and next() for a query.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  /// Binds one argument for each question mark of the statement. Texts must live until the last next().
  template <class... Values>
  void bind(const Values&... values) {
    assert(sqlite3_bind_parameter_count(statement_.get()) == static_cast<int>(sizeof...(values)));
    reset();
    int column = 0;
    (bind_at(++column, values), ...);
  }

  /// Runs it once with these arguments.
  template <class... Values>
  void row(const Values&... values) {
    bind(values...);
    next();
    reset();
  }

  // SQLite takes a text as it is at the step; not a number becomes NULL. Columns count from 1 here.
  void bind_at(int column, std::string_view text);
  void bind_at(int column, double number);
  void bind_at(int column, int number);
  void bind_at(int column, long long number);
  void bind_at(int column, std::nullptr_t);

  /// Goes to the next row of a query; false after the last.
  bool next();
  void reset();

  // Of the row that next() went to; columns count from 0 here. NULL is no text, NaN, 0.
  std::optional<std::string> text(int column) const;
  double number(int column) const;
  long long integer(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace flankwright::studies
