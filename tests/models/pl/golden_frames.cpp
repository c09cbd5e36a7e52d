// Writes the golden sequence as PGM files for the reference RTL, and turns the RTL's dump into the
// files of tests/data/golden.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "golden.h"
#include "golden_sequence.h"

namespace {

void write_frames(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const harness::GoldenFrame& frame : harness::golden_sequence()) {
    const std::filesystem::path file = folder / (frame.name + ".pgm");
    harness::write_pgm(file.string(), frame.image, 640, 480);
    std::cout << file.string() << '\n';
  }
}

void write_golden_files(const std::string& dump, const std::filesystem::path& folder) {
  const std::vector<harness::Golden> frames = harness::read_golden(dump);
  const std::vector<harness::GoldenFrame> sequence = harness::golden_sequence();
  if (frames.size() != sequence.size()) throw std::runtime_error("not a dump of all frames");
  std::ofstream prints(folder / "fingerprints.txt");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].name != sequence[i].name) throw std::runtime_error("frames in another order");
    if (sequence[i].complete) {
      std::ofstream words(folder / (frames[i].name + ".words"));
      harness::write_golden(words, frames[i]);
    } else {
      prints << harness::fingerprint(frames[i]) << '\n';
    }
  }
}

}  // namespace

/// libsystemc refers to it.
extern "C" int sc_main(int, char**) {
  return 1;
}

int main(int argc, char** argv) try {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "frames" && argc == 3) {
    write_frames(argv[2]);
  } else if (command == "pack" && argc == 4) {
    write_golden_files(argv[2], argv[3]);
  } else {
    std::cerr << "usage: golden_frames frames FOLDER | golden_frames pack DUMP FOLDER\n";
    return 2;
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
