#include "studies/exchange/rexs/rexs_errors.hpp"
#include "studies/exchange/rexs/rexs_archive.hpp"

#include <zip.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>

namespace flankwright::studies::rexs {

namespace {

constexpr std::array<std::string_view, 4> endings{".rexs", ".rexsj", ".xml", ".json"};

/// An error as libzip says it, whose memory is let go.
struct ZipError {
  zip_error_t error{};
  ZipError() { zip_error_init(&error); }
  ~ZipError() { zip_error_fini(&error); }
  ZipError(const ZipError&) = delete;
  ZipError& operator=(const ZipError&) = delete;
};

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;
using Entry = std::unique_ptr<zip_file_t, decltype(&zip_fclose)>;

Archive open(std::string_view bytes, const std::string& name) {
  ZipError problem;
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &problem.error);
  zip_t* archive = source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &problem.error);
  if (archive == nullptr) {
    if (source != nullptr) zip_source_free(source);
    refuse(name, 0, "file", "a damaged ZIP archive", std::string("a whole one (") + zip_error_strerror(&problem.error) + ")");
  }
  return {archive, &zip_discard};
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Index of the entry that is the model.
zip_uint64_t model_entry(zip_t* archive, const std::string& name) {
  std::vector<zip_uint64_t> models, files;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* raw = zip_get_name(archive, index, 0);
    const std::string entry = lower_case(raw == nullptr ? "" : raw);
    if (entry.empty() || entry.ends_with('/')) continue;  // a folder
    files.push_back(index);
    if (std::ranges::any_of(endings, [&](std::string_view ending) { return entry.ends_with(ending); })) models.push_back(index);
  }
  if (models.empty() && files.size() == 1) return files.front();
  if (models.size() != 1)
    refuse(name, 0, "file", "an archive with " + std::to_string(models.size()) + " models", "one entry .rexs, .rexsj, .xml or .json");
  return models.front();
}

}  // namespace

bool is_archive(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

std::string unpack(std::string_view bytes, const std::string& name) {
  const Archive archive = open(bytes, name);
  const Entry entry{zip_fopen_index(archive.get(), model_entry(archive.get(), name), 0), &zip_fclose};
  const auto refuse_entry = [&](const char* why) {
    refuse(name, 0, "file", "a damaged or encrypted ZIP archive", std::string("one that can be unpacked (") + why + ")");
  };
  if (!entry) refuse_entry(zip_strerror(archive.get()));
  // What the archive says of its size is not believed.
  std::string text;
  std::array<char, 1U << 16U> part{};
  for (;;) {
    const zip_int64_t count = zip_fread(entry.get(), part.data(), part.size());
    if (count < 0) refuse_entry(zip_file_strerror(entry.get()));
    if (count <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
    if (text.size() > largest_unpacked) refuse(name, 0, "file", "an archive of a larger file", std::to_string(largest_unpacked) + " bytes unpacked");
  }
}

}  // namespace flankwright::studies::rexs
