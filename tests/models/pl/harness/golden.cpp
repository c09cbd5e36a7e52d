#include "golden.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace harness {

namespace {

constexpr std::uint64_t clocks_per_binary_word = 32;

std::ifstream open(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path + ": cannot be opened");
  return in;
}

void read_word(std::istringstream& fields, char kind, std::vector<Word>& words) {
  Word word{kind, 0, 0, 0};
  fields >> word.clock >> std::hex >> word.first;
  if (kind == 'B') fields >> word.second;
  std::string repeated;
  fields >> repeated;
  const unsigned long copies = repeated.empty() ? 1 : std::stoul(repeated.substr(1));
  for (unsigned long i = 0; i < copies; ++i, word.clock += clocks_per_binary_word) {
    words.push_back(word);
  }
}

auto key(const Fingerprint& f) {
  return std::tie(f.name, f.words, f.threshold, f.hash);
}

}  // namespace

std::vector<Golden> read_golden(const std::string& path) {
  std::ifstream in = open(path);
  std::vector<Golden> frames;
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::string kind, name;
    fields >> kind;
    if (kind == "frame") {
      fields >> name;
      frames.emplace_back().name = std::filesystem::path(name).stem().string();
    } else if (frames.empty()) {
      continue;
    } else if (kind == "threshold") {
      fields >> frames.back().threshold;
    } else if (kind == "C" || kind == "B" || kind == "T") {
      read_word(fields, kind[0], frames.back().words);
    }
  }
  for (Golden& frame : frames) std::sort(frame.words.begin(), frame.words.end());
  return frames;
}

void write_golden(std::ostream& out, const Golden& frame) {
  out << "frame " << frame.name << '\n';
  for (const Word& word : frame.words) {
    if (word.kind != 'T') out << word << '\n';
  }
  std::vector<Word> binary;
  std::copy_if(frame.words.begin(), frame.words.end(), std::back_inserter(binary),
               [](const Word& word) { return word.kind == 'T'; });
  for (std::size_t i = 0; i < binary.size();) {
    std::size_t next = i + 1;
    while (next < binary.size() && binary[next].first == binary[i].first &&
           binary[next].clock == binary[next - 1].clock + clocks_per_binary_word) {
      ++next;
    }
    out << binary[i];
    if (next - i > 1) out << " x" << next - i;
    out << '\n';
    i = next;
  }
  out << "threshold " << frame.threshold << '\n';
}

bool operator==(const Fingerprint& a, const Fingerprint& b) {
  return key(a) == key(b);
}

std::ostream& operator<<(std::ostream& out, const Fingerprint& f) {
  return out << f.name << ' ' << f.words << ' ' << f.threshold << ' ' << std::hex << f.hash
             << std::dec;
}

Fingerprint fingerprint(const Golden& frame) {
  return {frame.name, frame.words.size(), frame.threshold, hash(frame.words)};
}

std::vector<Fingerprint> read_fingerprints(const std::string& path) {
  std::ifstream in = open(path);
  std::vector<Fingerprint> prints;
  for (Fingerprint f; in >> f.name >> f.words >> f.threshold >> std::hex >> f.hash >> std::dec;) {
    prints.push_back(f);
  }
  return prints;
}

}  // namespace harness
