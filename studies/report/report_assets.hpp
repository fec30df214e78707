#pragma once

#include <string_view>

/// The files of page/ and the plot library as they stood at build time; written by embed.cmake.
namespace flankwright::studies::assets {

extern const std::string_view page_html;          ///< template with {{placeholders}}
extern const std::string_view page_css;           ///< style sheet
extern const std::string_view page_script;        ///< our scripts, concatenated in their order
extern const std::string_view page_main;          ///< and what fills a report with them
extern const std::string_view comparison_script;  ///< or a comparison of runs
extern const std::string_view chart_library;      ///< Chart.js, minified, with its banner
extern const std::string_view notices;            ///< licence notices of what is inlined

}  // namespace flankwright::studies::assets
