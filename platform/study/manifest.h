#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <facts/unit.h>
#include <study/expansion.h>
#include <study/spec.h>
#include <nlohmann/json.hpp>

namespace platform::study {

using Json = nlohmann::ordered_json;

/// How inputs become units of work, for all points.
struct InputChoice {
  std::map<std::string, std::string> settings;  ///< InputRequest::settings
  std::optional<std::uint64_t> frames;
  std::uint64_t repeat = 1;
};

/// Points of one program whose other parameters follow from the same choices: their effective
/// configurations differ only in numbers that were set.
struct Family {
  std::string program;                               ///< name or file
  std::map<std::string, std::string> configuration;  ///< effective, complete
  std::map<std::string, std::string> defaults;       ///< of the same parameters
  Json contents;                                     ///< hashes of the program and of table files
  std::string problem = {};                          ///< why it cannot be built; not in the file
};

/// Inputs as they are named and as they are.
struct InputSet {
  std::vector<std::string> inputs;
  Json contents;            ///< name and hash of each
  facts::InputNeed need{};  ///< what the design takes
};

/// One point.
struct PlannedPoint {
  std::string key;  ///< hash of what decides its result
  std::size_t family = 0;
  std::size_t input_set = 0;
  Assignment changes;  ///< to the family's configuration, sorted by path
  Assignment swept;    ///< as the sweep's file has it
};

/// A step of a sensitivity analysis, by the keys of its points.
struct KeyedEffect {
  std::string from;
  std::string to;
  std::string path;
  double delta = 0;
};

/// A sweep that was checked: all its points. It goes to manifest.json, from which any engine works.
struct Manifest {
  std::string name;
  std::string title;
  std::string text;
  std::string source;  ///< the sweep's file
  Json program;        ///< version, revision of markervp
  Json tables;         ///< hashes of the installed data tables
  InputChoice input;
  std::string sampling;            ///< "grid", "morris", …; "search" of `markervp explore`
  std::vector<std::string> swept;  ///< paths in order
  std::vector<std::vector<std::string>> zipped;  ///< of them, those that move together
  std::string job;                               ///< see Spec::job; empty: the usual
  std::vector<std::string> metrics;
  std::vector<std::string> objectives;
  std::vector<std::string> constraints;  ///< on metrics; those on parameters chose the points
  std::vector<Family> families;
  std::vector<InputSet> input_sets;
  std::vector<PlannedPoint> points;  ///< without duplicates, in the order of the sweep
  std::vector<KeyedEffect> effects;

  /// The swept paths; those that move together are one entry.
  std::vector<std::vector<std::string>> dimensions() const;
  /// Everything that decides the point's result, as JSON.
  std::string identity(const PlannedPoint& point) const;
  /// Calls visit(path, value) for its complete effective configuration, sorted by path.
  template <class Visit>
  void visit_configuration(const PlannedPoint& point, const Visit& visit) const;
  /// What is set to get it: the values that are not their defaults.
  std::map<std::string, std::string> settings(const PlannedPoint& point) const;
};

template <class Visit>
void Manifest::visit_configuration(const PlannedPoint& point, const Visit& visit) const {
  // Both are sorted.
  auto change = point.changes.begin();
  for (const auto& [path, value] : families[point.family].configuration) {
    for (; change != point.changes.end() && change->first.text() < path; ++change)
      visit(change->first, change->second);
    const bool changed = change != point.changes.end() && change->first == path;
    visit(path, changed ? change->second.text() : value);
    if (changed) ++change;
  }
  for (; change != point.changes.end(); ++change) visit(change->first, change->second);
}

/// Manifest::identity() of one point after another: those of the family and inputs of the one
/// before take little more than their text.
class Identities {
 public:
  explicit Identities(const Manifest& manifest) : manifest_(manifest) {}

  std::string of(const PlannedPoint& point);

 private:
  /// What points of one family and with the same inputs share, in words.
  struct Shared {
    struct Line {
      std::string path;
      std::size_t begin, end;  ///< in the text, the comma included
    };
    std::string text;         ///< up to the last line of the configuration
    std::vector<Line> lines;  ///< by path
  };

  const Shared& shared_by(std::size_t family, std::size_t input_set);

  const Manifest& manifest_;
  std::map<std::pair<std::size_t, std::size_t>, Shared> shared_;  ///< by family and inputs
};

/// The hash of an identity.
std::string key_of(std::string_view identity);

/// As JSON, a line for each point. Throws vp::OutputError.
void write_manifest(const std::string& file, const Manifest& manifest);
/// Throws vp::InputError if it is no manifest of this version.
Manifest read_manifest(const std::string& file);

const char* to_string(Sampling::Method method);

/// Digits of a hash that name a point: 128 bits.
inline constexpr std::size_t key_digits = 32;

/// This program: version and revision; of sources that no revision names, the executable's hash.
Json program_identity(const std::string& version, const std::string& revision);

/// Hashes of the tables that are installed beside the program: costs of the software, power.
Json table_contents();

/// Hashes of the PS program's file, and of the files that the configuration names, with the files
/// that those name in turn.
Json file_contents(const std::string& program_file,
                   const std::map<std::string, std::string>& configuration);

}  // namespace platform::study
