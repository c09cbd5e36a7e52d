#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <hal/native_program.h>
#include <ps/cpu/machine_code.h>
#include <ps/memory/residents.h>

namespace ps {

/// A program's shared object in memory, from loading to unloading.
///
/// markervp_add_program links programs for addresses in the DDR, where the chip has them, and there
/// the loader puts them. Behind the static data begins the heap. One that was linked otherwise lies
/// where the host likes.
class ProgramImage {
 public:
  using Span = std::pair<std::uintptr_t, std::uintptr_t>;  ///< first byte, one past the last

  /// Throws vp::InputError and vp::ProtocolError as vp::load_object() does, and vp::InputError that
  /// names what occupies the program's addresses.
  explicit ProgramImage(const std::string& path);
  ~ProgramImage();
  ProgramImage(const ProgramImage&) = delete;
  ProgramImage& operator=(const ProgramImage&) = delete;

  /// The addresses that the file is linked for; {0, 0}: none in particular.
  static Span wanted_by(const std::string& path);

  void* symbol(const char* name) const;
  /// Of its code; null if the host's loader does not say.
  const MachineCode* code() const { return code_ ? &*code_ : nullptr; }
  /// One past its last byte in the DDR, the heap in use included; 0: it lies elsewhere.
  std::uint64_t end() const { return resident_ ? resident_->end() : 0; }

  /// Makes its variables, and the heap, what they were after loading.
  void restore() const;
  /// The heap may grow up to `end`.
  void end_heap_at(std::uintptr_t end) const;
  /// The DDR goes: from here on its malloc() is the C library's.
  void close_heap() const;

 private:
  struct Saved {
    unsigned char* address;
    std::size_t size;
    std::vector<unsigned char> bytes;  ///< empty: all are 0
  };
  void reserve_heap(const Span& wanted);
  void take_segments();
  void settle(const Span& wanted);
  void keep(std::uintptr_t first, std::uintptr_t end);

  std::string path_;
  void* handle_ = nullptr;
  Span heap_{0, 0};  ///< pages that are mapped for it
  std::uintptr_t bias_ = 0;
  std::vector<Span> mapped_, writable_;  ///< segments in whole pages; bytes of variables
  std::optional<MachineCode> code_;
  std::vector<Saved> saved_;
  std::optional<Resident> resident_;
};

}  // namespace ps
