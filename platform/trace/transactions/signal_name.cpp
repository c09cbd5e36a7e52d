#include <trace/transactions/signal_name.h>

#include <algorithm>
#include <array>
#include <cctype>

#include <trace/clock_choice.h>
#include <vp/text.h>

namespace platform::trace {

namespace {

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 4> directions = {"i", "o", "in", "out"};
/// What structures of requests and responses are called.
constexpr std::array<std::string_view, 8> sides = {"req",  "resp",  "rsp",     "res",
                                                   "reqs", "resps", "request", "response"};
/// Bundles of Chisel and SpinalHDL.
constexpr std::array<std::string_view, 2> bundles = {"bits", "payload"};

/// "gmem_AWVALID" is gmem, awvalid; "awValid" is aw, valid.
std::vector<std::string> split_words(std::string_view level) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < level.size(); ++i) {
    const auto c = static_cast<unsigned char>(level[i]);
    const bool turns = i > 0 && std::isupper(c) != 0 &&
                       std::islower(static_cast<unsigned char>(level[i - 1])) != 0;
    if ((c == '_' || turns) && !words.back().empty()) words.emplace_back();
    if (c != '_') words.back() += static_cast<char>(std::tolower(c));
  }
  if (words.back().empty() && words.size() > 1) words.pop_back();
  return words;
}

SignalName::Direction direction_of(std::string_view word) {
  if (!is_one_of(word, directions)) return SignalName::Direction::none;
  return word[0] == 'i' ? SignalName::Direction::in : SignalName::Direction::out;
}

/// A structure's level without direction and side.
void strip_structure(std::vector<std::string>& words) {
  if (words.size() > 1 && is_one_of(words.back(), directions)) words.pop_back();
  if (is_one_of(words.back(), sides)) words.pop_back();
}

/// The words of a signal's own level without its direction, which is returned.
SignalName::Direction strip_direction(std::vector<std::string>& words) {
  if (words.size() < 2) return SignalName::Direction::none;
  if (const auto last = direction_of(words.back()); last != SignalName::Direction::none) {
    words.pop_back();
    return last;
  }
  const auto first = direction_of(words.front());
  if (first != SignalName::Direction::none) words.erase(words.begin());
  return first;
}

}  // namespace

SignalName::SignalName(std::string_view path) {
  std::string_view own = path;
  if (!own.empty() && own.back() == ']') {
    const std::size_t bracket = own.rfind('[');
    if (bracket != std::string_view::npos && bracket > 0) {
      index_ = own.substr(bracket);
      own = own.substr(0, bracket);
    }
  }
  std::size_t dot = own.rfind('.');
  const std::size_t begin = dot == std::string_view::npos ? 0 : dot + 1;
  words = split_words(own.substr(begin));
  direction = strip_direction(words);
  words.erase(std::remove_if(words.begin(), words.end(),
                             [&](const auto& word) { return is_one_of(word, bundles); }),
              words.end());
  std::vector<std::string> before;
  std::string_view rest = begin == 0 ? std::string_view() : own.substr(0, dot);
  for (int level = 0; level < 2 && !rest.empty(); ++level) {
    dot = rest.rfind('.');
    const std::size_t from = dot == std::string_view::npos ? 0 : dot + 1;
    std::vector<std::string> structure = split_words(rest.substr(from));
    strip_structure(structure);
    before.insert(before.begin(), structure.begin(), structure.end());
    rest = from == 0 ? std::string_view() : rest.substr(0, dot);
  }
  words.insert(words.begin(), before.begin(), before.end());
  for (const char c : rest) {
    if (c != '_' && c != '.') key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  for (const std::string& word : words) key += word;
  key += index_;
}

bool SignalName::ends_in(std::string_view role) const {
  if (words.empty()) return false;
  constexpr std::size_t clear = 5;
  if (role.size() >= clear && (role.substr(0, 2) == "aw" || role.substr(0, 2) == "ar") &&
      vp::ends_with(words.back(), role)) {
    return true;
  }
  std::size_t left = role.size();
  for (auto word = words.rbegin(); word != words.rend() && left > 0; ++word) {
    if (word->size() > left || role.substr(left - word->size(), word->size()) != *word)
      return false;
    left -= word->size();
  }
  return left == 0;
}

std::string key_with(const std::string& stem, std::string_view role) {
  if (stem.empty() || stem.back() != ']') return stem + std::string(role);
  const std::size_t bracket = stem.rfind('[');
  return stem.substr(0, bracket) + std::string(role) + stem.substr(bracket);
}

std::string name_without(const std::string& path, std::string_view role) {
  std::string name = path, index;
  if (!name.empty() && name.back() == ']') {
    const std::size_t bracket = name.rfind('[');
    index = name.substr(bracket);
    name.erase(bracket);
  }
  const auto small = [&](std::size_t i) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  };
  // The role's letters from the right, behind a direction and with separators in between.
  for (const std::string_view direction : directions) {
    const std::string suffix = "_" + std::string(direction);
    if (vp::ends_with(vp::lower(name), suffix)) {
      name.erase(name.size() - suffix.size());
      break;
    }
  }
  std::size_t end = name.size();
  for (std::size_t left = role.size(); left > 0 && end > 0;) {
    if (small(end - 1) == role[left - 1]) --left;
    --end;
  }
  name.erase(end);
  const auto trim = [&] {
    while (!name.empty() && (name.back() == '_' || name.back() == '.')) name.pop_back();
  };
  const bool structure = !name.empty() && name.back() == '.';
  trim();
  if (structure) {
    for (bool again = true; again;) {
      again = false;
      const std::string own = vp::lower(name);
      const auto cut = [&](std::string_view word) {
        if (again || !vp::ends_with(own, word) || own.size() == word.size()) return;
        const char before = own[own.size() - word.size() - 1];
        if (before != '_' && before != '.') return;
        name.erase(name.size() - word.size());
        trim();
        again = true;
      };
      const std::size_t underline = own.rfind('_');
      if (underline != std::string::npos && own.find('.', underline) == std::string::npos)
        for (const std::string_view word : directions) cut(word);
      for (const std::string_view word : sides) cut(word);
    }
  }
  return name + index;
}

}  // namespace platform::trace
