#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "word.h"

namespace harness {

/// The golden words of one frame, as the reference RTL gave them.
struct Golden {
  std::string name;
  std::vector<Word> words;  ///< in the order of their clocks
  int threshold = -1;       ///< of the next frame
};

/// Reads a dump: lines "frame NAME", "C clock word", "B clock start end", "T clock word [xCOUNT]"
/// and "threshold N"; others are left out. With xCOUNT the word came COUNT times, every 32 clocks.
/// NAME loses its folder and extension. Throws std::runtime_error if the file cannot be read.
std::vector<Golden> read_golden(const std::string& path);

/// Writes one frame so that read_golden() gives it back; equal binary words become one line.
void write_golden(std::ostream& out, const Golden& frame);

/// A frame of which only a fingerprint is kept.
struct Fingerprint {
  std::string name;
  std::size_t words = 0;
  int threshold = -1;
  std::uint64_t hash = 0;
};
bool operator==(const Fingerprint& a, const Fingerprint& b);
std::ostream& operator<<(std::ostream& out, const Fingerprint& print);

Fingerprint fingerprint(const Golden& frame);

/// Reads lines "NAME WORDS THRESHOLD HASH". Throws std::runtime_error if the file cannot be read.
std::vector<Fingerprint> read_fingerprints(const std::string& path);

}  // namespace harness
