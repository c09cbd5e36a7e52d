#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ps {

/// The program that contains an address of code: a shared object, as it is mapped.
class CodeLocator {
 public:
  /// `inside`: any address in the shared object, for instance of its description.
  explicit CodeLocator(const void* inside);

  bool contains(std::uintptr_t address) const;
  /// "0x1a2b make(Mistake)+0x1c": the place in the file, as addr2line takes it, and the function
  /// around it. Only the place if the file was stripped.
  std::string text(std::uintptr_t address) const;
  /// The first of `addresses` that lies in the program; 0 if none does.
  std::uintptr_t first_inside(const std::vector<std::uintptr_t>& addresses) const;

 private:
  std::string file_;
  std::uintptr_t base_ = 0;
};

/// Of the calls that are under way, the innermost first: addresses inside the calling instructions.
std::vector<std::uintptr_t> return_addresses();

}  // namespace ps
