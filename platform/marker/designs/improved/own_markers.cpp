#include <marker/designs/improved/own_markers.h>

#include <fmt/format.h>

#include <cstring>

#include <apps/improved/own_dictionary.h>
#include <vp/error.h>

namespace platform {

namespace {

/// As the program has them: sw/apps/improved/options.h.
constexpr double usual_dictionary = 2;
constexpr std::uint32_t usual_border = 1;

}  // namespace

std::string OwnMarkers::read(const std::string& path) {
  own_ = input::read_dictionary_file(path);
  words_ = input::as_dictionary(own_);
  const improved::DictionaryData head{own_.cells, own_.words.size(), own_.distance, own_.border};
  const std::size_t bytes = own_.words.size() * sizeof own_.words[0];
  std::string data(sizeof head + bytes, '\0');
  std::memcpy(data.data(), &head, sizeof head);
  std::memcpy(data.data() + sizeof head, own_.words.data(), bytes);
  return data;
}

// Which of two answers is right is not guessed.
void OwnMarkers::check(const std::string& option, double value) {
  if (option == "dictionary") {
    if (words_ && value != usual_dictionary)
      throw vp::InputError("sw.dictionary and sw.dictionary_file are both set: leave one out");
    const auto which = static_cast<std::size_t>(value);
    // A program of the user's own may have others.
    if (which < marker::dictionaries.size()) cells_ = marker::dictionaries[which].cells;
    if (words_) cells_ = own_.cells;
  }
  if (option != "border_bits") return;
  const auto asked = static_cast<std::uint32_t>(value);
  const bool says = words_ && own_.border != 0;
  if (says && asked != usual_border && asked != own_.border) {
    throw vp::InputError(
        fmt::format("sw.border_bits is {}, and the dictionary's file says {}: leave it out", asked,
                    own_.border));
  }
  const std::uint32_t border = says ? own_.border : asked;
  if (improved::OwnDictionary::fits(cells_, border)) return;
  throw vp::InputError(fmt::format(
      "a border of {0} cells around codes of {1}x{1} is not read: what is more than one cell of it "
      "counts as cells of the code, which would be {2}x{2}, and {3}x{3} is the most",
      border, cells_, cells_ + 2 * (border - 1), marker::max_code_cells));
}

}  // namespace platform
