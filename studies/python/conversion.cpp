#include "studies/python/conversion.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/gear/gear_data.hpp"

namespace py = pybind11;

namespace flankwright::studies::python {

namespace {

constexpr int deepest = 16;  ///< tables within tables; a study has at most six

[[noreturn]] void refuse(py::handle value, const std::string& path, const std::string& allowed) {
  throw InvalidInput(path, py::str(py::repr(value)), allowed);
}

template <class Use>
void with_node(py::handle value, const std::string& path, int depth, const Use& use);

std::string below(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

toml::table table_of(py::handle mapping, const std::string& path, int depth) {
  toml::table table;
  if (depth > deepest) refuse(mapping, path, "at most 16 tables within each other");
  for (const py::handle item : mapping.attr("items")()) {
    const py::tuple pair = py::cast<py::tuple>(item);
    if (!py::isinstance<py::str>(pair[0])) refuse(pair[0], path, "a text as key");
    const std::string key = py::cast<std::string>(pair[0]);
    with_node(pair[1], below(path, key), depth, [&](auto&& node) { table.insert_or_assign(key, std::forward<decltype(node)>(node)); });
  }
  return table;
}

toml::array array_of(py::handle sequence, const std::string& path, int depth) {
  toml::array array;
  if (depth > deepest) refuse(sequence, path, "at most 16 lists within each other");
  int index = 0;
  for (const py::handle item : sequence) {
    with_node(item, below(path, std::to_string(index++)), depth, [&](auto&& node) { array.push_back(std::forward<decltype(node)>(node)); });
  }
  return array;
}

std::int64_t integer_of(py::handle value, const std::string& path) {
  const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) throw py::error_already_set();
  const long long integer = PyLong_AsLongLong(index.ptr());
  if (integer == -1 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(value, path, "an integer of 64 bits");
  }
  return integer;
}

/// Hands the value to `use` as what a study file calls it.
template <class Use>
void with_node(py::handle value, const std::string& path, int depth, const Use& use) {
  if (py::isinstance<py::str>(value)) return use(py::cast<std::string>(value));
  if (py::isinstance<py::bool_>(value)) return use(py::cast<bool>(value));
  if (py::hasattr(value, "__fspath__")) return use(py::cast<std::string>(value.attr("__fspath__")()));
  if (py::hasattr(value, "items")) return use(table_of(value, path, depth + 1));
  // Arrays and scalars of NumPy become lists and numbers.
  if (py::hasattr(value, "tolist")) return with_node(py::object(value.attr("tolist")()), path, depth + 1, use);
  if (PyIndex_Check(value.ptr()) != 0) return use(integer_of(value, path));
  if (PyNumber_Check(value.ptr()) != 0 && !value.is_none()) return use(py::cast<double>(py::float_(py::reinterpret_borrow<py::object>(value))));
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) return use(array_of(value, path, depth + 1));
  refuse(value, path, "a text, a truth value, a number, a list or a dict");
}

template <class Node>
std::string formatted(const Node& node) {
  std::ostringstream out;
  out << toml::toml_formatter{node, toml::toml_formatter::default_flags & ~toml::format_flags::indent_array_elements};
  return out.str();
}

py::object to_value(const toml::node& node);

py::list to_list(const toml::array& array) {
  py::list list;
  for (const toml::node& entry : array) list.append(to_value(entry));
  return list;
}

py::object to_value(const toml::node& node) {
  return node.visit([](const auto& is) -> py::object {
    using Node = std::remove_cvref_t<decltype(is)>;
    if constexpr (std::is_same_v<Node, toml::table>) {
      return to_dict(is);
    } else if constexpr (std::is_same_v<Node, toml::array>) {
      return to_list(is);
    } else if constexpr (toml::is_string<Node> || toml::is_integer<Node> || toml::is_floating_point<Node> || toml::is_boolean<Node>) {
      return py::cast(is.get());
    } else {
      return py::str(formatted(is));  // of a date or a time, which no key takes
    }
  });
}

/// The lengths of nested lists of numbers; nullopt where a list has something else, or lists side by side differ in length.
std::optional<std::vector<py::ssize_t>> shape_of(const Json& node) {
  if (node.is_number() || node.is_null()) return std::vector<py::ssize_t>{};
  if (!node.is_array() || node.empty()) return std::nullopt;
  std::optional<std::vector<py::ssize_t>> shape = shape_of(node.front());
  for (std::size_t i = 1; i < node.size() && shape; ++i) {
    if (shape_of(node[i]) != shape) return std::nullopt;
  }
  if (shape) shape->insert(shape->begin(), static_cast<py::ssize_t>(node.size()));
  return shape;
}

/// Whether there is a number anywhere: a list of nulls alone may stand for texts or objects.
bool has_number(const Json& node) {
  if (!node.is_array()) return node.is_number();
  for (const Json& entry : node) {
    if (has_number(entry)) return true;
  }
  return false;
}

void fill(const Json& node, double*& next) {
  if (node.is_array()) {
    for (const Json& entry : node) fill(entry, next);
  } else {
    *next++ = node.is_null() ? not_given : node.get<double>();
  }
}

}  // namespace

toml::table to_table(py::handle mapping) {
  if (!py::hasattr(mapping, "items")) refuse(mapping, "study", "a dict with the keys of a study file");
  return table_of(mapping, "", 0);
}

std::string to_text(py::handle value, const std::string& path) {
  std::string text;
  with_node(value, path, 0, [&](auto&& node) {
    using Node = std::remove_cvref_t<decltype(node)>;
    if constexpr (std::is_same_v<Node, toml::table>) {
      node.is_inline(true);
      text = formatted(node);
    } else if constexpr (std::is_same_v<Node, toml::array>) {
      text = formatted(node);
    } else {
      text = formatted(toml::value(node));
    }
  });
  return text;
}

py::dict to_dict(const toml::table& table) {
  py::dict dict;
  for (const auto& [key, value] : table) dict[py::str(std::string(key.str()))] = to_value(value);
  return dict;
}

py::object to_python(const Json& node) {
  switch (node.type()) {
    case Json::value_t::null:
      return py::none();
    case Json::value_t::boolean:
      return py::bool_(node.get<bool>());
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return py::int_(node.get<long long>());
    case Json::value_t::number_float:
      return py::float_(node.get<double>());
    case Json::value_t::string: {
      const auto& text = node.get_ref<const std::string&>();
      // A file name need not be UTF-8.
      return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
    }
    case Json::value_t::object: {
      py::dict dict;
      for (const auto& [key, value] : node.items()) dict[py::str(key)] = to_python(value);
      return dict;
    }
    default:
      break;
  }
  if (const auto shape = shape_of(node); shape && has_number(node)) {
    py::array_t<double> array(*shape);
    double* next = array.mutable_data();
    fill(node, next);
    return array;
  }
  py::list list;
  for (const Json& entry : node) list.append(to_python(entry));
  return list;
}

}  // namespace flankwright::studies::python
