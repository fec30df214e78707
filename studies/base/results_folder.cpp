#include "studies/base/results_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/base/error.hpp"

namespace flankwright::studies {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw InvalidInput("output folder", path.string(), "a place that can be written (" + reason + ")");
}

}  // namespace

void write_whole(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path temporary = file.string() + ".tmp" + std::to_string(::getpid());
  const int handle = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (handle < 0) refuse(file, std::strerror(errno));
  const auto give_up = [&](int error) {
    ::close(handle);
    ::unlink(temporary.c_str());
    refuse(file, std::strerror(error));
  };
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t step = ::write(handle, text.data() + written, text.size() - written);
    if (step < 0 && errno == EINTR) continue;
    if (step < 0) give_up(errno);
    written += static_cast<std::size_t>(step);
  }
  if (::fsync(handle) != 0) give_up(errno);
  if (::close(handle) != 0) {
    const int reason = errno;
    ::unlink(temporary.c_str());
    refuse(file, std::strerror(reason));
  }
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  if (error) {
    ::unlink(temporary.c_str());
    refuse(file, error.message());
  }
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error)) refuse(folder, error ? error.message() : "not a folder");
}

std::string read_whole(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code no_status;
  if (!in || std::filesystem::is_directory(file, no_status)) throw InvalidInput("file", file.string(), "a file that can be read");
  std::string text;
  // What has a size is read at once; a pipe has none.
  const auto size = std::filesystem::file_size(file, no_status);
  if (!no_status && size > 0) {
    text.resize(size);
    in.read(text.data(), static_cast<std::streamsize>(size));
    text.resize(static_cast<std::size_t>(in.gcount()));
  }
  text.append(std::istreambuf_iterator<char>(in), {});
  if (in.bad()) throw InvalidInput("file", file.string(), "a file that can be read");
  return text;
}

Json whole_results(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "results.json";
  std::error_code no_status;
  if (!std::filesystem::exists(file, no_status)) {
    throw InvalidInput("folder", folder.string(), "a folder with results.json, as `flankwright run` leaves it");
  }
  Json results = Json::parse(read_whole(file), nullptr, false);
  const auto has = [&](const char* key) { return results.contains(key); };
  const bool is_whole = results.is_object() && has("given") && has("used") && has("version") && (!has("loaded") || results.at("loaded").is_array());
  if (!is_whole) throw InvalidInput(file.string(), damaged_results, results_of_a_run);
  return results;
}

}  // namespace flankwright::studies
