#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vp/file.h>

#include "vcd_reader.h"

namespace vp {

/// Where a large VCD can be entered, and where each net changed last before that, so that the
/// values at a time are found without reading what comes before. Kept in a file beside the VCD, or
/// in the user's cache if its folder cannot be written.
///
/// It belongs to one content of the VCD, which its size, its time and a hash of both ends tell, and
/// what is taken from it is checked by sums: an index of another file, or a damaged one, is made
/// anew.
class VcdIndex {
 public:
  /// The index of `file`, made on the first call, which reads the whole VCD. Null for what cannot
  /// be entered (gzip, a pipe) and for a file that has a fault somewhere. `notes` gets what a user
  /// should know, and what is odd about the VCD.
  static std::unique_ptr<VcdIndex> of(const std::filesystem::path& file, const WaveOptions& options,
                                      WaveNotes& notes);

  /// The last place that is not after the time. None: the file begins later.
  std::optional<std::uint64_t> place_before(std::uint64_t steps) const;
  const VcdReader::Place& place(std::uint64_t number) const { return places_[number]; }
  /// The bytes at which these nets changed last before `place`, rising. Throws InputError if the
  /// index is damaged.
  std::vector<std::uint64_t> last_changes(const VcdReader::Place& place,
                                          const std::vector<std::uint32_t>& nets);

  struct Header;
  struct Span;

 private:
  VcdIndex(const std::filesystem::path& file, const std::filesystem::path& kept_as);
  bool read(const Header& expected, WaveNotes& notes);

  std::filesystem::path kept_as_;
  InputFile input_;
  std::uint64_t nets_ = 0, spans_at_ = 0;
  std::vector<VcdReader::Place> places_;
};

}  // namespace vp
