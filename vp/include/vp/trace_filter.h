#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// Chooses signals by their hierarchical names.
///
/// A list of patterns, each with `+` (take, the default) or `-` (leave out) before it; the last one
/// that matches a name decides. In a pattern `*` and `?` stand for any characters and one character
/// within a level, `**` as a whole level stands for any number of levels. A pattern without these
/// that names a module takes everything below it. If the first pattern is a `-`, everything else is
/// taken. No pattern at all: everything.
///
///     zynq.pl.**, -zynq.pl.blob_detection, +zynq.pl.blob_detection.out_*
class TraceFilter {
 public:
  TraceFilter() = default;
  /// Each element may itself hold several patterns, separated by commas or blanks.
  /// Throws InputError for a malformed pattern.
  TraceFilter(const std::vector<std::string>& patterns);

  bool selects(std::string_view path) const;

  /// Throws InputError if a `+` pattern matches none of `paths`, or if nothing of them is selected;
  /// the message tells what there is instead. `hidden`: paths that another trace level shows.
  void check(const std::vector<std::string>& paths, const std::vector<std::string>& hidden) const;

 private:
  struct Pattern {
    std::string text;  ///< as the user wrote it
    bool take;
    bool subtree;  ///< no wildcard: a module stands for what is below it
    std::vector<std::string> levels;
  };
  static Pattern parse(std::string_view text);
  static bool matches(const Pattern& pattern, std::string_view path);
  static std::string suggestion(const Pattern& pattern, const std::vector<std::string>& paths);

  std::vector<Pattern> patterns_;
};

/// The place in `paths` of a signal that a user wrote: its whole path, or the end of one path only
/// ("feature_overflow"). Throws InputError that begins with `where` and names what is near.
std::uint32_t find_path(const std::string& name, const std::vector<std::string>& paths,
                        const std::string& where = "");

}  // namespace vp
