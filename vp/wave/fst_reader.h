#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <vp/wave_reader.h>

#include "byte_arena.h"
#include "fst_changes.h"
#include "fst_file.h"
#include "wave_declared.h"

namespace vp {

/// Reads an FST: only the chains of the nets that are asked for are unpacked, a block at a time.
class FstReader {
 public:
  struct Net {
    WaveVariable::Kind kind;
    unsigned width;  ///< bits; 1 of a real or text
    bool is_port;    ///< of an extended VCD: its values are states and two strengths for each bit
    bool is_event = false;
    /// Characters of a value that is written as it is.
    std::size_t length() const { return is_port ? std::size_t{width} * 3 + 2 : width; }
  };
  /// Reads the hierarchy. Throws InputError.
  explicit FstReader(const std::filesystem::path& file);

  const std::vector<Net>& nets() const { return nets_; }
  /// In the order of the file.
  WaveDeclarations& declared() { return declared_; }
  std::vector<WaveEnumeration>& enumerations() { return enumerations_.all; }
  std::uint64_t timescale_fs() const { return timescale_fs_; }
  std::uint64_t bytes() const { return file_.size(); }
  /// What is odd about the file; empty if nothing is.
  std::string remark() const;

  /// The last block that is not after `steps`.
  std::uint64_t block_before(std::uint64_t steps);
  /// The next read() begins with the values at the start of a block, or of an earlier one.
  void enter(std::uint64_t block) { entry_ = block; }
  /// Hands over the changes of the selected nets, from where the last call stopped to the end or
  /// until the clock has enough. Throws InputError.
  void read(const std::vector<bool>& selected, WaveClock& clock, WaveHandler& handler);

 private:
  /// Where the chain of a handle is among the bytes of a block.
  struct Place {
    std::uint64_t at = 0;  ///< in the file; 0: no changes
    std::uint64_t size = 0;
    std::uint32_t same_as = 0;  ///< handle + 1 of the chain that is also this one's; 0: its own
  };
  void read_hierarchy();
  struct Scope {
    std::string path;
    bool is_array;
  };
  void read_variable(std::uint8_t type, fst::Cursor& cursor, const Scope& scope, bool has_geometry);

  /// `entered`: nothing was read before it.
  void open_block(const fst::File::Section& section, const std::vector<bool>& selected,
                  bool entered);
  /// Returns where the table of chains ends.
  std::uint64_t read_times(const fst::File::Section& section);
  std::uint64_t next_time();
  std::vector<Place> read_places(const fst::File::Section& section, std::uint64_t changes_at,
                                 std::uint64_t table_end, std::uint64_t handles) const;
  void unpack_chains(const std::vector<Place>& places, char method,
                     const std::vector<bool>& selected);
  FstChanges::Chain chain_of(std::uint32_t net, std::string_view bytes) const;
  void hand_over_frame(const std::vector<bool>& selected, WaveHandler& handler);
  bool hand_over_block(WaveClock& clock, const std::vector<bool>& selected, WaveHandler& handler);
  void hand_over(const FstChanges::Change& change, WaveHandler& handler);
  std::string_view digits_of(std::uint64_t bits, unsigned width);
  void hand_over_packed(const FstChanges::Change& change, WaveHandler& handler);
  void hand_over_bits(std::uint32_t net, std::string_view digits, WaveHandler& handler);
  void hand_over_real(std::uint32_t net, const char* bytes, WaveHandler& handler);
  [[noreturn]] void corrupt_changes() const;

  fst::File file_;
  std::vector<Net> nets_;
  WaveDeclarations declared_;
  WaveEnumerations enumerations_;
  std::uint64_t timescale_fs_ = 1;
  std::uint64_t handles_ = 0;  ///< declared so far
  std::uint64_t path_bytes_ = 0;

  // The block that is being read.
  std::size_t block_ = 0;  ///< counts the opened ones
  bool open_ = false;
  std::size_t instant_ = 0;  ///< its time was handed over if `announced_`
  bool announced_ = false;
  bool frame_due_ = false;  ///< the block's first values were not handed over
  std::optional<std::uint64_t> entry_;
  std::vector<std::uint64_t> starts_;  ///< times of the blocks, once they are asked for
  std::uint64_t block_start_ = 0, block_end_ = 0;
  std::string times_;           ///< a number for each instant: the steps since the one before
  std::uint64_t times_at_ = 0;  ///< in the file
  std::size_t times_taken_ = 0, instants_ = 0;
  std::uint64_t now_ = 0;  ///< of `instant_`, once it was announced
  std::string frame_;
  std::string window_;  ///< bytes of the file, read at once
  ByteArena unpacked_;  ///< chains point into it
  FstChanges changes_;
  bool needs_texts_ = true;  ///< of the handler
  std::string text_;
};

}  // namespace vp
