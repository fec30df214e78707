#pragma once

#include <string>

namespace flankwright::studies {

/// CSV field of a name: quoted where it holds a comma, a quote or a line break. A spreadsheet takes a cell that begins with = + - or @
/// for a formula: an apostrophe before it, the spreadsheet's own mark of a text, keeps it a name. Numbers stay numbers.
std::string csv_field(const std::string& text);
/// CSV field of a number with all its digits; empty where it was not computed.
std::string csv_field(double number);

}  // namespace flankwright::studies
