#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// The candidate that `word` is most likely a misspelling of; empty if none is near. Compared by
/// Damerau-Levenshtein distance, at most max(2, length / 3); also with the last part of a dotted
/// candidate, so that "treshold" finds "pl.trigger.threshold". Of equally near ones the
/// first wins.
std::string nearest_match(std::string_view word, const std::vector<std::string>& candidates);

/// Insertions, deletions, substitutions and swaps of neighbours that turn one text into the other.
std::size_t edit_distance(std::string_view from, std::string_view to);

std::string join(const std::vector<std::string>& parts, std::string_view separator);
/// "a", "a or b", "a, b or c".
std::string one_of(const std::vector<std::string>& names);
/// All parts, empty ones too: "a..b" at '.' is "a", "", "b".
std::vector<std::string> split(std::string_view text, char separator);
/// Without white space at both ends.
std::string_view trim(std::string_view text);
/// Letters of ASCII as small ones, whatever the locale.
std::string lower(std::string_view text);
/// Letters of ASCII as capitals, whatever the locale.
std::string upper(std::string_view text);
bool ends_with(std::string_view text, std::string_view end);
/// With `decimals` places after the point ("12.30"), whatever the locale. Never "-0.00".
std::string format_fixed(double value, int decimals);
/// "0x41200000": at least eight digits, for messages.
std::string hex(std::uint64_t value);
/// A text that a user wrote, for messages: of more than 200 characters the beginning and "...".
std::string excerpt(std::string_view text);
/// A text from outside as one line that commands nothing: control characters, which move a cursor
/// or end a line, and marks that turn the direction of writing become "\\n", "\\x1b", "\\u202e".
std::string visible(std::string_view text);
/// The same of a text of several lines: line feeds stay.
std::string visible_lines(std::string_view text);

/// For the expressions of traces and of sweeps: both are parsed and evaluated recursively, and
/// neither may use up the stack.
struct ExpressionLimits {
  static constexpr std::size_t most_parts = 1000;  ///< values and operators
  static constexpr std::size_t deepest = 100;      ///< brackets and signs inside each other
};

}  // namespace vp
