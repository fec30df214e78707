#pragma once

#include <string>
#include <string_view>

namespace flankwright::studies::rexs {

/// Whether these are the bytes of a ZIP archive, as .rexsz and .rexs.zip are.
bool is_archive(std::string_view bytes);

/// The text of the one REXS file in an archive: the entry that ends in .rexs, .rexsj, .xml or .json, or the only one there is. Other
/// entries, such as pictures and tables of the format, are ignored.
///
/// @param name  stands for the archive in messages
/// @throws StudyErrors with one problem: a damaged or encrypted archive, none or several such entries, or one of more than
/// largest_unpacked bytes
std::string unpack(std::string_view bytes, const std::string& name);

/// A file of a gear unit has megabytes; an archive of a few bytes can hold gigabytes of zeros.
inline constexpr std::size_t largest_unpacked = std::size_t{1} << 26U;

}  // namespace flankwright::studies::rexs
