#include <vp/text.h>

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <cstdio>

namespace vp {
namespace {

std::string_view last_part(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

/// True if so few edits can be a misspelling. Texts without a common letter never count as one,
/// however short.
bool near(std::size_t distance, std::string_view word, std::string_view candidate) {
  return distance <= std::max<std::size_t>(2, word.size() / 3) &&
         distance < std::max(word.size(), candidate.size());
}

/// False if the lengths alone keep them from being near: a word may be a megabyte long.
bool may_be_near(std::string_view word, std::string_view candidate) {
  const std::size_t least =
      std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size());
  return near(least, word, candidate);
}

}  // namespace

std::size_t edit_distance(std::string_view from, std::string_view to) {
  // Optimal string alignment: three rows of the Damerau-Levenshtein matrix.
  std::vector<std::size_t> before_last(to.size() + 1), last(to.size() + 1), row(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (from[i - 1] != to[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row[to.size()];
}

std::string nearest_match(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string* best = nullptr;
  std::size_t best_distance = 0;
  for (const std::string& candidate : candidates) {
    if (!may_be_near(word, candidate)) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (near(distance, word, candidate) && (best == nullptr || distance < best_distance)) {
      best = &candidate;
      best_distance = distance;
    }
  }
  if (best != nullptr) return *best;

  // Right name in the wrong place: nearest by the last part, then by the whole path.
  std::pair<std::size_t, std::size_t> best_pair;
  const std::string_view word_part = last_part(word);
  for (const std::string& candidate : candidates) {
    const std::string_view part = last_part(candidate);
    if (!may_be_near(word_part, part)) continue;
    const std::size_t distance = edit_distance(word_part, part);
    if (!near(distance, word_part, part)) continue;
    const std::pair pair{distance, edit_distance(word, candidate)};
    if (best == nullptr || pair < best_pair) {
      best = &candidate;
      best_pair = pair;
    }
  }
  return best == nullptr ? std::string() : *best;
}

std::string join(const std::vector<std::string>& parts, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i != 0) text += separator;
    text += parts[i];
  }
  return text;
}

std::string one_of(const std::vector<std::string>& names) {
  if (names.size() < 2) return join(names, "");
  return join({names.begin(), names.end() - 1}, ", ") + " or " + names.back();
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view white = " \t\r\n";
  const std::size_t first = text.find_first_not_of(white);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(white) - first + 1);
}

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

std::string upper(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return capitals;
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string format_fixed(double value, int decimals) {
  char buffer[512];
  const auto result =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals);
  if (result.ec != std::errc{}) return "";
  std::string text(buffer, result.ptr);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string hex(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%08" PRIX64, value);
  return text;
}

namespace {

/// The code of a control character, or of a mark of direction, that begins with these bytes, and
/// how many bytes it has; none has 0.
std::pair<unsigned, std::size_t> control_at(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  if (byte(0) < 0x20 || byte(0) == 0x7f) return {byte(0), 1};
  if (byte(0) == 0xc2 && byte(1) >= 0x80 && byte(1) < 0xa0) return {byte(1), 2};
  if (byte(0) != 0xe2 || (byte(1) != 0x80 && byte(1) != 0x81)) return {0, 0};
  const unsigned code = 0x2000 + ((byte(1) & 0x3f) << 6) + (byte(2) & 0x3f);
  const bool turns = (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) ||
                     code == 0x200e || code == 0x200f;
  return {code, turns ? 3 : 0};
}

std::string escape_of(unsigned code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  char text[16];
  std::snprintf(text, sizeof text, code < 0x100 ? "\\x%02x" : "\\u%04x", code);
  return text;
}

std::string visible_but(std::string_view text, char kept) {
  std::string result;
  while (!text.empty()) {
    const auto [code, size] = control_at(text);
    const bool stays = size == 0 || (kept != 0 && text.front() == kept);
    result += stays ? std::string(1, text.front()) : escape_of(code);
    text.remove_prefix(stays ? 1 : size);
  }
  return result;
}

}  // namespace

std::string visible(std::string_view text) {
  return visible_but(text, 0);
}

std::string visible_lines(std::string_view text) {
  return visible_but(text, '\n');
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 200;
  if (text.size() <= longest) return std::string(text);
  const auto continues_character = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;  // UTF-8
  };
  std::size_t end = longest;
  while (end > 0 && continues_character(end)) --end;
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace vp
