#pragma once

#include <string>
#include <string_view>

/// Whatever the bytes, a reader returns or throws InvalidInput: each of these runs one and lets nothing else through.
namespace flankwright::studies::fuzz {

void read_study_text(std::string_view text);
void read_grid_text(std::string_view text);
/// Also what the reader accepted must be a study that check accepts.
void read_rexs_text(std::string_view text);

}  // namespace flankwright::studies::fuzz
