#include "word.h"

#include <algorithm>
#include <sstream>
#include <tuple>

namespace harness {

namespace {

auto key(const Word& w) {
  return std::tie(w.clock, w.kind, w.first, w.second);
}

std::string text(const std::vector<Word>& words, std::size_t i) {
  if (i >= words.size()) return "nothing";
  std::ostringstream out;
  out << words[i];
  return out.str();
}

}  // namespace

bool operator==(const Word& a, const Word& b) {
  return key(a) == key(b);
}
bool operator<(const Word& a, const Word& b) {
  return key(a) < key(b);
}

std::ostream& operator<<(std::ostream& out, const Word& w) {
  out << w.kind << ' ' << std::dec << w.clock << std::hex << ' ' << w.first;
  if (w.kind == 'B') out << ' ' << w.second;
  return out << std::dec;
}

std::string first_difference(const std::vector<Word>& a, const std::vector<Word>& b) {
  const std::size_t common = std::min(a.size(), b.size());
  std::size_t i = 0;
  while (i < common && a[i] == b[i]) ++i;
  if (i == a.size() && i == b.size()) return "";
  return "word " + std::to_string(i) + ": " + text(a, i) + " against " + text(b, i);
}

std::uint64_t hash(const std::vector<Word>& words) {
  std::uint64_t h = 0xCBF2'9CE4'8422'2325;
  auto mix = [&h](std::uint64_t value) {
    for (int i = 0; i < 8; ++i, value >>= 8) h = (h ^ (value & 0xFF)) * 0x100'0000'01B3;
  };
  for (const Word& w : words) {
    mix(static_cast<std::uint64_t>(w.kind));
    mix(w.clock);
    mix(w.first);
    mix(w.second);
  }
  return h;
}

std::size_t count(const std::vector<Word>& words, char kind) {
  return static_cast<std::size_t>(std::count_if(
      words.begin(), words.end(), [kind](const Word& word) { return word.kind == kind; }));
}

}  // namespace harness
