#pragma once

#include <string>

namespace flankwright::studies {

/// A value from the command line: --set key=value. The value is TOML, or a text without its quotes ("3 arcmin"); the
/// key is a dotted path, in which a number picks a table of [[scenes]], counted from 0. It replaces what the file says,
/// and, of keys that exclude each other (normal_module and normal_diametral_pitch), removes the other.
struct Override {
  std::string key, value;
};

}  // namespace flankwright::studies
