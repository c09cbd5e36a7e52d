#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <facts/unit.h>
#include <nlohmann/json.hpp>

namespace platform::study {

using Json = nlohmann::ordered_json;

/// As text. File names may hold any bytes, JSON only UTF-8: others are replaced.
std::string json_text(const Json& json);

/// A text of which points have many: a path, a value. Equal ones are one object, which stays until
/// the program ends: so a point of a million costs some hundred bytes.
class Word {
 public:
  Word(const std::string& text);
  Word(const char* text) : Word(std::string(text)) {}
  Word() : Word("") {}

  const std::string& text() const { return *text_; }
  operator const std::string&() const { return *text_; }

  friend bool operator==(const Word& a, const Word& b) { return a.text_ == b.text_; }
  friend bool operator!=(const Word& a, const Word& b) { return a.text_ != b.text_; }
  friend bool operator==(const Word& a, const std::string& b) { return *a.text_ == b; }
  friend bool operator!=(const Word& a, const std::string& b) { return *a.text_ != b; }

 private:
  const std::string* text_;
};

/// The swept values of one point, in the order of the axes: path and value.
using Assignment = std::vector<std::pair<Word, Word>>;

/// The value of this path; null if missing.
const std::string* find(const Assignment& values, const std::string& path);

/// How inputs become units of work, for all points.
struct InputChoice {
  std::map<std::string, std::string> settings;  ///< InputRequest::settings
  std::optional<std::uint64_t> frames;
  std::uint64_t repeat = 1;
};

/// All that a run needs: what its platform is built from, and what it works on.
struct Setup {
  std::string program;                          ///< name or file; empty: the usual
  std::map<std::string, std::string> settings;  ///< path -> value; all others have their defaults
  std::vector<std::string> inputs = {};
  InputChoice input = {};
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

/// What is asked: a set of settings and inputs. Of its origin it has the places only, so that there
/// may be millions.
struct Point {
  std::string key;  ///< hash of what decides its result
  std::size_t family = 0;
  std::size_t input_set = 0;
  Assignment changes;  ///< to the family's configuration, sorted by path
  Assignment swept;    ///< as the sweep's file has it
};

/// What points have in common: program, tables, inputs, and what their settings are changes to.
struct Origins {
  Json program;  ///< version, revision of markervp
  Json tables;   ///< hashes of the installed data tables
  InputChoice input;
  std::vector<Family> families;
  std::vector<InputSet> input_sets;

  /// Everything that decides the point's result, as JSON.
  std::string identity(const Point& point) const;
  /// Calls visit(path, value) for its complete effective configuration, sorted by path.
  template <class Visit>
  void visit_configuration(const Point& point, const Visit& visit) const;
  /// What is set to get it: the values that are not their defaults.
  std::map<std::string, std::string> settings(const Point& point) const;
  /// What a run of it needs.
  Setup setup(const Point& point) const;
};

template <class Visit>
void Origins::visit_configuration(const Point& point, const Visit& visit) const {
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

/// Origins::identity() of one point after another: those of the family and inputs of the one
/// before take little more than their text.
class Identities {
 public:
  explicit Identities(const Origins& origins) : origins_(origins) {}

  std::string of(const Point& point);

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

  const Origins& origins_;
  std::map<std::pair<std::size_t, std::size_t>, Shared> shared_;  ///< by family and inputs
};

/// The hash of an identity.
std::string key_of(std::string_view identity);

/// Digits of a hash that name a point: 128 bits.
inline constexpr std::size_t key_digits = 32;

/// Whether a text is the key of a point.
bool is_key(std::string_view text);

}  // namespace platform::study
