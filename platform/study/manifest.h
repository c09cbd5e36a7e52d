#pragma once

#include <string>
#include <vector>

#include <study/point.h>

namespace platform::study {

/// A step of a sensitivity analysis, by the keys of its points.
struct KeyedEffect {
  std::string from;
  std::string to;
  std::string path;
  double delta = 0;
};

/// A sweep that was checked: all its points. It goes to manifest.json, from which any engine works.
struct Manifest : Origins {
  std::string name;
  std::string title;
  std::string text;
  std::string source;              ///< the sweep's file
  std::string sampling;            ///< "grid", "morris", …; "search" of `markervp explore`
  std::vector<std::string> swept;  ///< paths in order
  std::vector<std::vector<std::string>> zipped;  ///< of them, those that move together
  std::string job;                               ///< see Spec::job; empty: the usual
  Json figures = Json::array();  ///< that designs declare (result::own_figures_json)
  std::vector<std::string> metrics;
  std::vector<std::string> objectives;
  std::vector<std::string> constraints;  ///< on metrics; those on parameters chose the points
  std::vector<Point> points;             ///< without duplicates, in the order of the sweep
  std::vector<KeyedEffect> effects;

  /// The swept paths; those that move together are one entry.
  std::vector<std::vector<std::string>> dimensions() const;
};

/// As JSON, a line for each point. Throws vp::OutputError.
void write_manifest(const std::string& file, const Manifest& manifest);
/// Throws vp::InputError if it is no manifest of this version.
Manifest read_manifest(const std::string& file);

}  // namespace platform::study
