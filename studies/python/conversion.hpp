#pragma once

#include <pybind11/pybind11.h>
#include <toml++/toml.h>

#include <string>

#include "studies/base/json_format.hpp"

/// Values of Python as those of a study file, and those of results.json as values of Python.
namespace flankwright::studies::python {

/// A mapping with texts as keys as the table of a study file. Values are texts and paths, truth values, integers, numbers (those of NumPy as
/// well), sequences, arrays and mappings.
/// @throws InvalidInput with the dotted path of what a study file cannot hold
toml::table to_table(pybind11::handle mapping);

/// A value as the text that stands behind the equals sign of a study file.
std::string to_text(pybind11::handle value, const std::string& path);

/// A table of a study file as dict, list, str, int, float and bool. The inverse of to_table().
pybind11::dict to_dict(const toml::table& table);

/// A node of results.json. Lists of numbers, and lists of such lists as far as they have one length, become arrays of float64 with NaN for null;
/// objects become dicts, other lists stay lists, and null by itself is None.
pybind11::object to_python(const Json& node);

}  // namespace flankwright::studies::python
