// Feeds 640x480 PGM frames, in order and without a system reset between, through the Verilated
// RTL of the thesis' structure, and prints every word in the format of tests/data/golden.
#include <exception>
#include <iostream>

#include "rtl_pipeline.h"

namespace {

constexpr std::size_t frame_pixels = 640 * 480;

void dump(bench::ThesisRtl& rtl, const std::string& file) {
  const harness::Image image = harness::read_pgm(file);
  if (image.size() != frame_pixels) throw std::runtime_error(file + ": not 640x480 pixels");
  rtl.load(image);
  rtl.run_frame();
  std::cout << "frame " << file << '\n';
  for (const harness::Word& word : rtl.words()) std::cout << word << '\n';
  std::cout << "threshold " << rtl.threshold() << '\n';
}

}  // namespace

// libsystemc refers to sc_main; nothing enters through it.
extern "C" int sc_main(int, char**) {
  return 0;
}

int main(int argc, char** argv) try {
  bench::ThesisRtl rtl;
  for (int i = 1; i < argc; ++i) dump(rtl, argv[i]);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
