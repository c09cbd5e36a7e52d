#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace platform::study {

/// Values from a start to a stop, both included, as the user wrote them.
struct ValueRange {
  std::string start;
  std::string stop;
  std::optional<std::string> step;
  std::optional<std::uint32_t> count;
  bool logarithmic = false;
};

/// The values of one parameter: a list, or a range.
struct Axis {
  std::string path;   ///< a parameter of `markervp config`, or system, program, inputs
  std::string where;  ///< "clocks.yaml:7"
  std::vector<std::string> values;
  std::optional<ValueRange> range;
};

/// Axes that move together (zipped); usually one.
struct Dimension {
  std::vector<Axis> axes;
};

/// How points are chosen from the dimensions.
struct Sampling {
  enum class Method { grid, random, sobol, morris, one_at_a_time };

  Method method = Method::grid;
  std::string where;
  std::uint64_t points = 0;  ///< of random and Sobol
  std::uint64_t seed = 1;
  std::uint32_t trajectories = 10;  ///< of Morris
  std::uint32_t levels = 4;         ///< of Morris, even
};

const char* to_string(Sampling::Method method);

/// How `markervp explore` chooses points.
struct SearchChoice {
  std::string where;              ///< empty: the file does not say
  std::uint64_t points = 2000;    ///< at most
  std::uint32_t generation = 40;  ///< points that are chosen together
  std::uint32_t patience = 10;    ///< generations without gain, before it ends
  std::uint64_t seed = 1;
  std::optional<std::string> time;  ///< at most, "10 min"
};

struct Condition {
  std::string text;
  std::string where;
};

/// A sweep as its file says it. Nothing is checked against the platform yet.
struct Spec {
  std::string name;   ///< of the file, without folder and extension
  std::string title;  ///< one line
  std::string text;   ///< what it teaches; printed at the end
  std::string origin;
  std::string source;  ///< the file's text

  std::vector<std::string> inputs;                             ///< empty: the usual
  std::map<std::string, std::vector<std::string>> input_sets;  ///< of the axis `inputs`, by label
  std::string program;                                         ///< or system; empty: the usual
  std::map<std::string, std::string> input_settings;           ///< by InputSetting::name
  std::optional<std::uint64_t> frames;
  std::uint64_t repeat = 1;
  std::map<std::string, std::string> set;
  std::string set_where;

  std::vector<Dimension> dimensions;
  Sampling sampling;
  SearchChoice search;
  std::vector<Condition> constraints;   ///< on parameters, and on metrics; a rate is one of these
  std::optional<Condition> job;         ///< what a point must have done; none: the usual
  std::vector<std::string> metrics;     ///< columns; empty: all
  std::vector<std::string> objectives;  ///< "max summary.fps.mean"
};

/// Reads a sweep's file. Throws vp::InputError: file, line, what is wrong, the nearest key.
Spec read_spec(const std::string& file);
/// The same for text.
Spec parse_spec(const std::string& text, const std::string& origin);

/// A sweep that comes with the program.
struct Study {
  std::string name;
  std::string title;
  std::string file;
};

/// All of them, by name.
std::vector<Study> studies();

/// The file of a sweep: `name` itself if it is one, or a study of that name. Throws vp::InputError
/// with the nearest name.
std::string sweep_file(const std::string& name);

}  // namespace platform::study
