#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
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
  /// The index that `file` has; null if it has none. `notes` gets what a user should know, and what
  /// is odd about the VCD.
  static std::unique_ptr<VcdIndex> kept(const std::filesystem::path& file,
                                        const WaveOptions& options, WaveNotes& notes);
  /// Makes one, for which the whole VCD is read. Null, and a note that says why, if the VCD has a
  /// fault somewhere or the index cannot be written.
  static std::unique_ptr<VcdIndex> made(const std::filesystem::path& file,
                                        const WaveOptions& options, WaveNotes& notes);
  /// The VCD is large, and so is what lies before `steps`: else reading from the front is sooner
  /// done than an index.
  static bool is_worth_it(const std::filesystem::path& file, const WaveOptions& options,
                          std::uint64_t steps);

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
  static std::unique_ptr<VcdIndex> opened(const std::filesystem::path& file,
                                          const std::filesystem::path& name, const Header& key,
                                          WaveNotes& notes);
  bool read(const Header& expected, WaveNotes& notes);

  std::filesystem::path kept_as_;
  InputFile input_;
  std::uint64_t nets_ = 0, spans_at_ = 0;
  std::vector<VcdReader::Place> places_;
};

}  // namespace vp
