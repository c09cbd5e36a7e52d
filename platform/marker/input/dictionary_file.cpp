#include <marker/input/dictionary_file.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>

#include <marker/input/calibration_file.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::input {

namespace {

/// A thousand words of 49 cells are 70 KiB of text, and AprilTag's largest family is 2 MiB of C.
constexpr std::uint64_t largest_dictionary = 4 << 20;

/// Smaller codes tell nothing; the option's borders.
constexpr std::uint32_t least_cells = 3, most_border = 3;
constexpr long long most_width = marker::max_code_cells + 2 * most_border;

constexpr const char* accepted_dictionaries =
    "give what OpenCV's Dictionary::writeDictionary() writes, or the C source of a family of "
    "AprilTag's";

/// Least number of cells in which two words differ, however turned; 0: words `same[0]` and
/// `same[1]` are the same marker. A word that equals itself turned makes it 1.
std::uint32_t distance_of(const OwnDictionary& own, std::array<std::size_t, 2>& same) {
  const auto between = [](std::uint64_t a, std::uint64_t b) {
    return static_cast<std::uint32_t>(std::bitset<64>(a ^ b).count());
  };
  std::uint32_t least = own.cells * own.cells;
  for (std::size_t a = 0; a < own.words.size(); ++a) {
    std::uint64_t turned = own.words[a];
    for (unsigned turns = 0; turns < 4; ++turns) {
      if (turns > 0) least = std::min(least, std::max(between(turned, own.words[a]), 1U));
      for (std::size_t b = a + 1; b < own.words.size(); ++b) {
        least = std::min(least, between(turned, own.words[b]));
        if (least > 0) continue;
        same = {a, b};
        return 0;
      }
      turned = marker::rotate_clockwise(turned, own.cells);
    }
  }
  return least;
}

/// Of the part of a file that has words, row by row, the top left cell first; 1 = white.
using Bits = std::vector<bool>;

class DictionaryReader {
 public:
  explicit DictionaryReader(const std::string& path) : what_("dictionary '" + path + "'") {
    result_.name = std::filesystem::path(path).stem().string();
  }

  void take_side(long long cells) {
    if (cells < least_cells || cells > marker::max_code_cells) {
      fail("codes of " + std::to_string(cells) + " cells a side: " + std::to_string(least_cells) +
           " to " + std::to_string(marker::max_code_cells) + " are read");
    }
    result_.cells = static_cast<std::uint32_t>(cells);
  }

  void take_border(long long cells) {
    if (cells < 1 || cells > most_border) {
      fail("a border " + std::to_string(cells) + " cells wide: 1 to " +
           std::to_string(most_border) + " are read");
    }
    result_.border = static_cast<std::uint32_t>(cells);
  }

  std::size_t bits() const { return std::size_t{result_.cells} * result_.cells; }
  std::uint32_t side() const { return result_.cells; }

  /// The next ID's.
  void take_word(const Bits& white) {
    std::uint64_t word = 0;
    for (const bool is_white : white) word = word << 1 | (is_white ? 0U : 1U);
    result_.words.push_back(word);
  }

  OwnDictionary take() {
    const std::size_t count = result_.words.size();
    if (count == 0) fail("no words");
    if (count > marker::max_dictionary_size) {
      fail(std::to_string(count) + " words: a program has room for " +
           std::to_string(marker::max_dictionary_size) + ", so leave out what you do not use");
    }
    const std::uint64_t black = (std::uint64_t{1} << bits()) - 1;
    const auto plain = std::find(result_.words.begin(), result_.words.end(), black);
    if (plain != result_.words.end()) {
      fail("marker " + std::to_string(plain - result_.words.begin()) +
           " is black all over, and would be found in anything dark: leave it out");
    }
    std::array<std::size_t, 2> same{};
    result_.distance = distance_of(result_, same);
    if (result_.distance == 0) {
      fail("markers " + std::to_string(same[0]) + " and " + std::to_string(same[1]) +
           " are the same one, or one is the other turned: their distance is 0, so leave one out");
    }
    return std::move(result_);
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw vp::InputError(what_ + ": " + problem);
  }

 private:
  std::string what_;
  OwnDictionary result_;
};

// ---- OpenCV ----

/// The entries of one dictionary by their last names, which a name may be before.
class DictionaryEntries {
 public:
  DictionaryEntries(std::vector<CalibrationEntry> entries, const DictionaryReader& reader)
      : reader_(reader) {
    for (CalibrationEntry& entry : entries) {
      std::string name = plain_name(entry.name.substr(entry.name.rfind('.') + 1));
      by_name_.emplace(std::move(name), std::move(entry));
    }
  }

  /// Null: the file has none.
  const CalibrationEntry* find(const std::string& name) const {
    const auto [first, last] = by_name_.equal_range(plain_name(name));
    if (first == last) return nullptr;
    if (std::next(first) != last)
      reader_.fail("more than one entry '" + name + "': a file holds one dictionary");
    return &first->second;
  }

  const CalibrationEntry& need(const std::string& name) const {
    const CalibrationEntry* const found = find(name);
    if (found == nullptr) reader_.fail("no entry '" + name + "': " + accepted_dictionaries);
    return *found;
  }

  long long whole(const std::string& name) const {
    const CalibrationEntry& entry = need(name);
    const double value = entry.numbers.size() == 1 ? entry.numbers.front() : -1;
    if (!(value >= 0 && value <= static_cast<double>(largest_dictionary) &&
          value == std::floor(value)))
      reader_.fail("'" + vp::excerpt(entry.name) + "' is no number of cells or markers");
    return static_cast<long long>(value);
  }

 private:
  std::multimap<std::string, CalibrationEntry> by_name_;
  const DictionaryReader& reader_;
};

/// "marker_7: 0110…", 1 = white.
void read_marker_texts(const DictionaryEntries& entries, DictionaryReader& reader) {
  const auto name = [](long long id) { return "marker_" + std::to_string(id); };
  const long long count = entries.whole("nmarkers");
  for (long long id = 0; id < count; ++id) {
    const std::string& text = entries.need(name(id)).text;
    if (text.size() != reader.bits() || text.find_first_not_of("01") != std::string::npos)
      reader.fail("'" + name(id) + "' is not " + std::to_string(reader.bits()) + " times 0 or 1");
    Bits white;
    for (const char cell : text) white.push_back(cell == '1');
    reader.take_word(white);
  }
  if (entries.find(name(count)) != nullptr)
    reader.fail("a '" + name(count) + "', although 'nmarkers' is " + std::to_string(count));
}

/// OpenCV's own form: bytes, the last of them not full, for each of the four turns.
void read_byte_list(const CalibrationEntry& list, DictionaryReader& reader) {
  const std::size_t each = (reader.bits() + 7) / 8;
  const auto is_byte = [](double v) { return v == std::floor(v) && v >= 0 && v <= 255; };
  if (list.rows == 0 || list.numbers.size() != list.rows * 4 * each ||
      !std::all_of(list.numbers.begin(), list.numbers.end(), is_byte)) {
    reader.fail("'" + vp::excerpt(list.name) + "' does not have 4 times " + std::to_string(each) +
                " bytes a marker, as codes of " + std::to_string(reader.side()) +
                " cells a side have");
  }
  const std::size_t in_last = reader.bits() - (each - 1) * 8;
  const auto bits_at = [&](std::size_t at) {
    Bits white;
    for (std::size_t byte = 0; byte < each; ++byte) {
      const auto value = static_cast<unsigned>(list.numbers[at + byte]);
      for (std::size_t left = byte + 1 == each ? in_last : 8; left-- > 0;)
        white.push_back((value >> left & 1U) != 0);
    }
    return white;
  };
  for (std::size_t row = 0; row < list.rows; ++row) {
    const std::size_t at = row * 4 * each;
    const Bits upright = bits_at(at);
    Bits upside_down = bits_at(at + 2 * each);
    std::reverse(upside_down.begin(), upside_down.end());
    if (upright != upside_down) {
      reader.fail("the turns of marker " + std::to_string(row) + " in '" + vp::excerpt(list.name) +
                  "' are not those of one marker of " + std::to_string(reader.side()) +
                  " cells a side");
    }
    reader.take_word(upright);
  }
}

void read_opencv(const std::string& text, const std::string& what, DictionaryReader& reader) {
  const DictionaryEntries entries(read_file_storage(text, what), reader);
  reader.take_side(entries.whole("markersize"));
  const CalibrationEntry* list = entries.find("bytelist");
  if (list == nullptr) list = entries.find("byteslist");
  if (list != nullptr) return read_byte_list(*list, reader);
  read_marker_texts(entries, reader);
}

// ---- AprilTag ----

std::string without_c_comments(const std::string& text) {
  std::string code;
  for (std::size_t at = 0; at < text.size();) {
    const bool is_line = text.compare(at, 2, "//") == 0;
    if (!is_line && text.compare(at, 2, "/*") != 0) {
      code += text[at++];
      continue;
    }
    const std::size_t end = is_line ? text.find('\n', at) : text.find("*/", at + 2);
    if (end == std::string::npos) break;
    at = is_line ? end : end + 2;
  }
  return code;
}

/// What C says a number is at a place, if it is one.
std::optional<long long> c_number_at(const std::string& code, std::size_t& at) {
  at = std::min(code.find_first_not_of(" \t\r\n", at), code.size());
  char* end = nullptr;
  const char* const begin = code.c_str() + at;
  const long long value = *begin == '-' ? std::strtoll(begin, &end, 0)
                                        : static_cast<long long>(std::strtoull(begin, &end, 0));
  if (end == begin) return std::nullopt;
  at += static_cast<std::size_t>(end - begin);
  return value;
}

bool skip(const std::string& code, std::size_t& at, char expected) {
  at = std::min(code.find_first_not_of(" \t\r\n", at), code.size());
  if (at == code.size() || code[at] != expected) return false;
  ++at;
  return true;
}

/// The numbers that a C source assigns to a member of a family: `tf->NAME = 3;`, by index 0, or
/// `tf->NAME[2] = 3;`.
std::map<long long, long long> assigned(const std::string& code, const std::string& name) {
  std::map<long long, long long> values;
  const std::string member = "->" + name;
  for (std::size_t at = 0; (at = code.find(member, at)) != std::string::npos;) {
    at += member.size();
    long long index = 0;
    if (skip(code, at, '[')) {
      const auto known = c_number_at(code, at);
      if (!known || !skip(code, at, ']')) continue;
      index = *known;
    }
    if (!skip(code, at, '=')) continue;
    if (const auto value = c_number_at(code, at)) values[index] = *value;
  }
  return values;
}

/// `static uint64_t codedata[587] = { 0x0000000d7e00984bUL, … };`, or `tf->codes[0] = …;` each.
std::vector<std::uint64_t> codes_in(const std::string& code, const DictionaryReader& reader) {
  std::vector<std::uint64_t> codes;
  for (const auto& [id, value] : assigned(code, "codes")) {
    if (id != static_cast<long long>(codes.size()))
      reader.fail("no codes[" + std::to_string(codes.size()) + "]: each ID has one");
    codes.push_back(static_cast<std::uint64_t>(value));
  }
  std::size_t at = code.find("codedata[");
  if (at != std::string::npos) at = code.find('{', at);
  while (at != std::string::npos && at < code.size()) {
    const auto value = c_number_at(code, ++at);
    if (!value) break;
    codes.push_back(static_cast<std::uint64_t>(*value));
    at = code.find(',', at);
  }
  const auto count = assigned(code, "ncodes");
  if (!count.empty() && count.begin()->second != static_cast<long long>(codes.size())) {
    reader.fail(std::to_string(codes.size()) + " codes, although 'ncodes' is " +
                std::to_string(count.begin()->second));
  }
  return codes;
}

long long first_of(const std::string& code, const char* name) {
  const auto values = assigned(code, name);
  return values.empty() ? 0 : values.begin()->second;
}

/// Where the bits of a code are in the square of its cells, row by row, the highest bit first.
std::vector<std::size_t> places_in(const std::string& code, DictionaryReader& reader) {
  const auto x = assigned(code, "bit_x"), y = assigned(code, "bit_y");
  std::vector<std::size_t> places;
  if (x.empty()) {  // version 2: row by row
    reader.take_side(first_of(code, "d"));
    reader.take_border(first_of(code, "black_border"));
    for (std::size_t i = 0; i < reader.bits(); ++i) places.push_back(i);
    return places;
  }
  const auto refuse = [&reader] {
    reader.fail(
        "the code's cells are no square inside of a black border: families with cells outside of "
        "a border that is bright inside of dark, as AprilTag's Standard, Circle and Custom ones, "
        "are not read");
  };
  const long long border = std::min_element(x.begin(), x.end(), [](const auto& a, const auto& b) {
                             return a.second < b.second;
                           })->second;
  const long long width = first_of(code, "width_at_border");
  if (border < 1 || width > most_width || 2 * border >= width) refuse();
  reader.take_side(width - 2 * border);
  reader.take_border(border);
  const long long side = reader.side();
  std::vector<bool> is_taken(reader.bits());
  for (const auto& [bit, column] : x) {
    const auto row = y.find(bit);
    const auto is_inside = [&](long long cell) { return cell >= border && cell < border + side; };
    if (row == y.end() || !is_inside(column) || !is_inside(row->second)) refuse();
    const auto place = static_cast<std::size_t>((row->second - border) * side + column - border);
    if (is_taken[place]) refuse();
    is_taken[place] = true;
    places.push_back(place);
  }
  if (places.size() != reader.bits()) refuse();
  return places;
}

void read_apriltag(const std::string& text, DictionaryReader& reader) {
  const std::string code = without_c_comments(text);
  const std::vector<std::size_t> places = places_in(code, reader);
  for (const std::uint64_t value : codes_in(code, reader)) {
    if (value >> reader.bits() != 0) reader.fail("a code of more than its cells' bits");
    Bits white(reader.bits());
    for (std::size_t i = 0; i < places.size(); ++i)
      white[places[i]] = (value >> (places.size() - 1 - i) & 1U) != 0;
    reader.take_word(white);
  }
}

}  // namespace

marker::Dictionary as_dictionary(const OwnDictionary& own) {
  return {own.name.c_str(), own.cells, static_cast<std::uint32_t>(own.words.size()), own.distance,
          own.words.data()};
}

OwnDictionary read_dictionary_file(const std::string& path) {
  const std::string text = vp::read_text(path, "dictionary", largest_dictionary);
  DictionaryReader reader(path);
  if (text.find('\0') != std::string::npos)
    reader.fail(std::string("no text: ") + accepted_dictionaries);
  if (text.find("apriltag_family") != std::string::npos) {
    read_apriltag(text, reader);
  } else {
    read_opencv(text, "dictionary '" + path + "'", reader);
  }
  return reader.take();
}

}  // namespace platform::input
