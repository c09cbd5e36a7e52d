#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ps {

/// Memory of a loaded program that lies where the DDR is, for as long as the object lives. A
/// FixedMapping that is made around it takes over its variables, so that devices see them, and
/// gives them back when it ends.
class Resident {
 public:
  /// A part of it, whole pages [first, end).
  struct Part {
    std::uint64_t first, end;
    bool variables;  ///< otherwise code and constants, which stay the program's own
  };

  /// `parts` by address, within one program.
  Resident(std::string program, std::vector<Part> parts);
  ~Resident();
  Resident(const Resident&) = delete;
  Resident& operator=(const Resident&) = delete;

  const std::string& program() const { return program_; }
  const std::vector<Part>& parts() const { return parts_; }
  std::uint64_t first() const { return parts_.front().first; }
  std::uint64_t end() const { return parts_.back().end; }

  /// Those that lie in [first, end), at least in part, by address.
  static std::vector<const Resident*> in(std::uint64_t first, std::uint64_t end);

 private:
  std::string program_;
  std::vector<Part> parts_;
};

/// Has the host map the pages of [first, first + bytes), which are written next. All at once take a
/// fraction of the time that they take one by one; a few are left to that, and so are all where the
/// host does not offer it.
void map_ahead(const void* first, std::size_t bytes);

/// Sets bytes of a program to 0, as copy_variables().
void clear_variables(void* to, std::size_t size);

/// Copies bytes of a program. Its sanitizer's gaps between variables are copied, too.
void copy_variables(void* to, const void* from, std::size_t size);

}  // namespace ps
