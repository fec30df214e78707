#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "studies/analysis/study_notes.hpp"
#include "studies/base/keep_freed_memory.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/base/unit_of_name.hpp"
#include "studies/base/version.hpp"
#include "studies/command_line/finished_run.hpp"
#include "studies/python/conversion.hpp"
#include "studies/python/listening.hpp"
#include "studies/report/report.hpp"
#include "studies/results/gathered.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/study_file/study_schema.hpp"

/// The Python module flankwright._flankwright: the functions of the command line, with studies as dicts and results as arrays. What a user
/// imports, flankwright/__init__.py, stands on it.
namespace py = pybind11;

namespace flankwright::studies::python {

namespace {

/// What Python keeps of a run: not the meshes, which are large.
struct Results {
  std::string folder;  ///< that files were written to; empty: none
  Json document;
  std::string summary, different;
  std::vector<std::string> notes, requirements;

  bool met() const { return requirements.empty() && different.empty(); }
};

/// Raises flankwright.InvalidInput.
void raise(const char* message, const std::vector<StudyProblem>& problems) {
  const py::module_ errors = py::module_::import("flankwright.errors");
  py::list all;
  for (const StudyProblem& p : problems) all.append(errors.attr("Problem")(p.file, p.line, p.column, p.key, p.value, p.allowed));
  const py::object type = errors.attr("InvalidInput");
  PyErr_SetObject(type.ptr(), type(message, all).ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const StudyErrors& errors) {
    raise(errors.what(), errors.problems());
  } catch (const InvalidInput& problem) {
    raise(problem.what(), {{"", 0, 0, problem.field(), problem.value(), problem.allowed()}});
  }
}

std::vector<Override> overrides_of(const py::dict& values) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : values) {
    const auto path = py::cast<std::string>(key);
    overrides.push_back({path, to_text(value, path)});
  }
  return overrides;
}

/// A dict has no lines: the problems of its text are those of its keys.
Study study_of(const py::handle& values, const std::string& file) {
  std::ostringstream text;
  text << toml::toml_formatter{to_table(values)};
  try {
    return parse_study(text.str(), file);
  } catch (const StudyErrors& errors) {
    std::vector<StudyProblem> problems = errors.problems();
    for (StudyProblem& problem : problems) problem.line = problem.column = 0;
    throw StudyErrors(std::move(problems));
  }
}

Results run(const Study& study, const std::optional<std::filesystem::path>& out, const std::optional<int>& threads, const py::object& progress) {
  if (threads && *threads < 1) throw InvalidInput("threads", std::to_string(*threads), "an integer of at least 1");
  const std::filesystem::path folder = out.value_or(std::filesystem::path());
  if (!folder.empty()) make_folder(folder);
  Listening listening(progress);
  spdlog::set_level(py::isinstance<py::bool_>(progress) && py::cast<bool>(progress) ? spdlog::level::info : spdlog::level::off);
  return listening.run([&](const ProgressReport& report) {
    std::optional<tbb::global_control> limit;
    if (threads) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(*threads));
    FinishedRun run = finish_study(study, folder, report);
    if (!folder.empty()) write_files(run, folder);
    std::string summary = summary_table(run.results);
    return Results{folder.string(),          std::move(run.document),      std::move(summary),
                   std::move(run.different), std::move(run.results.notes), std::move(run.results.requirements)};
  });
}

/// Results as a folder has them.
Results stored_results(const std::filesystem::path& folder) {
  Json document = whole_results(folder);
  try {
    std::vector<std::string> notes = document.at("notes"), requirements = document.at("requirements_not_met");
    std::string different = document.value("not_as_expected", "");
    return {folder.string(), std::move(document), "", std::move(different), std::move(notes), std::move(requirements)};
  } catch (const Json::exception&) {
    throw InvalidInput((folder / "results.json").string(), damaged_results, results_of_a_run);
  }
}

/// "gradients" behind the load case in a name: "loaded.0.summary.x" -> "loaded.0.gradients.summary.x".
std::string gradient_name(const std::string& name) {
  constexpr std::string_view loaded = "loaded.";
  if (!name.starts_with(loaded)) throw InvalidInput("quantity", name, "a quantity below loaded: others have no derivatives");
  std::size_t at = loaded.size();
  const std::size_t end = name.find_first_not_of("0123456789", at);
  if (end != std::string::npos && end > at && name[end] == '.') at = end + 1;
  return name.substr(0, at) + "gradients." + name.substr(at);
}

void bind_study(py::module_& module) {
  py::class_<Study, std::shared_ptr<Study>>(module, "Study")
      .def(py::init([](const py::object& values, const std::string& file) { return std::make_shared<Study>(study_of(values, file)); }),
           py::arg("values"), py::arg("file") = "study")
      .def_static(
          "load",
          [](const std::filesystem::path& path, const py::dict& values) {
            return std::make_shared<Study>(read_study(path.string(), overrides_of(values)));
          },
          py::arg("path"), py::arg("values") = py::dict())
      .def_static(
          "from_toml", [](const std::string& text, const std::string& file) { return std::make_shared<Study>(parse_study(text, file)); },
          py::arg("text"), py::arg("file") = "study")
      .def(
          "replace",
          [](const Study& study, const py::dict& values) {
            return std::make_shared<Study>(parse_study(study.text, study.file, overrides_of(values)));
          },
          py::arg("values"))
      .def("to_dict", [](const Study& study) { return to_dict(toml::parse(study.text)); })
      .def("to_toml", [](const Study& study) { return study.text; })
      .def(
          "save", [](const Study& study, const std::filesystem::path& path) { write_whole(path, study.text + "\n"); }, py::arg("path"))
      .def_property_readonly("title", [](const Study& study) { return study.title; })
      .def_property_readonly("task", [](const Study& study) { return std::string(study.task->name); })
      .def_property_readonly("file", [](const Study& study) { return study.file; })
      .def_property_readonly("notes",
                             [](const Study& study) {
                               const GearPair pair = make_gear_pair(study.pair);
                               std::vector<std::string> notes = study_notes(study, pair);
                               if (std::string backlash = backlash_in_words(pair); !backlash.empty())
                                 notes.insert(notes.begin(), std::move(backlash));
                               return notes;
                             })
      .def("__eq__",
           [](const Study& study, const py::object& other) {
             return py::isinstance<Study>(other) && toml::parse(py::cast<const Study&>(other).text) == toml::parse(study.text);
           })
      .def("__repr__", [](const Study& study) { return py::str("<flankwright.Study {!r}: {}>").format(study.title, study.task->name); })
      .def(py::pickle([](const Study& study) { return py::make_tuple(study.text, study.file); },
                      [](const py::tuple& state) {
                        return std::make_shared<Study>(parse_study(py::cast<std::string>(state[0]), py::cast<std::string>(state[1])));
                      }));
}

void bind_results(py::module_& module) {
  py::class_<Results>(module, "Results")
      .def("__getitem__", [](const Results& results, const std::string& name) { return to_python(gathered(results.document, name)); })
      .def("__contains__",
           [](const Results& results, const std::string& name) {
             try {
               gathered(results.document, name);
               return true;
             } catch (const InvalidInput&) {
               return false;
             }
           })
      .def("keys",
           [](const Results& results) {
             std::vector<std::string> keys;
             for (const auto& [key, value] : results.document.items()) keys.push_back(key);
             return keys;
           })
      .def(
          "unit", [](const Results&, const std::string& name) { return std::string(unit_of_name(name)); }, py::arg("name"))
      .def(
          "gradient", [](const Results& results, const std::string& name) { return to_python(gathered(results.document, gradient_name(name))); },
          py::arg("name"))
      .def_property_readonly("parameters",
                             [](const Results& results) {
                               const Json& loaded = results.document.at("loaded");
                               const bool any = !loaded.empty() && loaded.front().contains("gradients");
                               std::vector<std::pair<std::string, std::string>> parameters;
                               for (std::size_t i = 0; any && i < loaded.front()["gradients"]["parameters"].size(); ++i) {
                                 parameters.emplace_back(loaded.front()["gradients"]["parameters"][i], loaded.front()["gradients"]["units"][i]);
                               }
                               return parameters;
                             })
      .def("json", [](const Results& results) { return json_text(results.document); })
      .def("report", [](const Results& results) { return render_report(results.document); })
      .def_property_readonly("task", [](const Results& results) { return results.document.at("task").get<std::string>(); })
      .def_property_readonly("title", [](const Results& results) { return results.document.at("title").get<std::string>(); })
      .def_readonly("folder", &Results::folder)
      .def_readonly("summary", &Results::summary)
      .def_readonly("notes", &Results::notes)
      .def_readonly("requirements_not_met", &Results::requirements)
      .def_readonly("not_as_expected", &Results::different)
      .def_property_readonly("met", &Results::met)
      .def("__repr__", [](const Results& results) {
        return py::str("<flankwright.Results {!r}: {}{}>")
            .format(results.document.at("title").get<std::string>(), results.document.at("task").get<std::string>(),
                    results.met() ? "" : ", requirements not met");
      });
}

void bind_progress(py::module_& module) {
  py::class_<Progress>(module, "Progress")
      .def(py::init<>())
      .def("show", &Progress::show, py::arg("label"), py::arg("done"), py::arg("total"), py::arg("remark") = "")
      .def("finish", &Progress::finish);
}

/// Every key of a study file, as the key reference has it.
py::list keys() {
  py::list all;
  for (const SchemaKey& key : study_schema()) {
    all.append(py::make_tuple(key.path, std::string(default_unit(key.quantity)), key.fallback, allowed_values(key), key.meaning));
  }
  return all;
}

}  // namespace

}  // namespace flankwright::studies::python

PYBIND11_MODULE(_flankwright, module) {
  using namespace flankwright::studies;
  keep_freed_memory();
  py::register_exception_translator(python::translate);
  spdlog::set_default_logger(spdlog::stderr_color_mt("flankwright"));
  spdlog::set_pattern("%^%l%$: %v");
  module.attr("__version__") = version();
  python::bind_study(module);
  python::bind_results(module);
  python::bind_progress(module);
  module.def("keys", &python::keys);
  module.def("stored_results", &python::stored_results, py::arg("folder"));
  module.def("run", &python::run, py::arg("study"), py::arg("out"), py::arg("threads"), py::arg("progress"));
}
