// Writes the traces of the worked examples of appendix C into a folder.
#include <exception>
#include <filesystem>
#include <iostream>

#include "examples.h"

/// libsystemc refers to it.
extern "C" int sc_main(int, char**) {
  return 1;
}

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: appendix_c_traces FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const appendix_c::Example& example : appendix_c::examples()) {
    const std::filesystem::path file = folder / (example.name + ".vcd");
    example.write_trace(file);
    std::cout << file.string() << '\n';
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
