#pragma once

#include <array>
#include <string_view>

namespace flankwright::studies {

/// A page that `flankwright docs` knows by name and that every page leads to.
struct NamedPage {
  std::string_view name, file, meaning;  ///< file from the folder of the pages
};

inline constexpr std::array documentation_pages{
    NamedPage{"start", "README.html", "what the program does and what it does not model"},
    NamedPage{"tutorial", "studies/tutorial.html", "your own gear from the drawing to the grinding sheet, in ten steps"},
    NamedPage{"guide", "studies/README.html", "how a study is written and run"},
    NamedPage{"how-to", "studies/how-to.html", "noise, wide faces, test rigs, clusters, measured flanks: half a page each"},
    NamedPage{"keys", "studies/keys.html", "every key of a study file"},
    NamedPage{"results", "studies/results.html", "every file and quantity that a run writes"},
    NamedPage{"life", "studies/life.html", "damage, film thickness and contact temperature over a load spectrum"},
    NamedPage{"accuracy", "studies/tasks/accuracy/README.html", "what accuracy costs in time"},
    NamedPage{"gallery", "studies/examples/README.html", "what other studies show"},
    NamedPage{"notation", "core/notation.html", "symbols, words and signs"},
    NamedPage{"changes", "CHANGELOG.html", "what is new"},
};

}  // namespace flankwright::studies
