#include "fst_file.h"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace vp::fst {

namespace {

constexpr std::uint64_t head_size = 9;  ///< of a block: type and length
constexpr double byte_order = 2.7182818284590452354;

}  // namespace

File::File(const std::filesystem::path& file)
    : path_(file), input_(file, "trace"), descriptor_(input_.descriptor()), size_(input_.size()) {
  char first = 0;
  read(0, &first, 1);
  if (static_cast<Block>(first) == packed) unpack_whole();
  read_blocks();
}

void File::fail(const std::string& problem, std::uint64_t at) const {
  throw InputError("trace '" + path_.string() + "': " + problem + ", at byte " +
                   std::to_string(at) + (unpacked_ ? " of what is packed in it" : ""));
}

void File::read(std::uint64_t at, char* to, std::size_t size) const {
  while (size > 0) {
    const ssize_t count = ::pread(descriptor_, to, size, static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(std::strerror(errno), at);
    if (count == 0) fail("truncated", at);
    to += count;
    at += static_cast<std::uint64_t>(count);
    size -= static_cast<std::size_t>(count);
  }
}

std::string File::read(std::uint64_t at, std::uint64_t size) const {
  if (at > size_ || size > size_ - at) fail("truncated or corrupt", at);
  std::string bytes(size, '\0');
  read(at, bytes.data(), bytes.size());
  return bytes;
}

std::string File::read_packed(std::uint64_t at, std::uint64_t packed,
                              std::uint64_t unpacked) const {
  std::string bytes = read(at, packed);
  if (packed == unpacked) return bytes;
  if (unpacked > most_unpacked('Z', packed)) fail("corrupt: a size that cannot be", at);
  std::string result(unpacked, '\0');
  if (!unpack('Z', bytes, result.data(), result.size())) {
    fail("corrupt: what is packed cannot be unpacked", at);
  }
  return result;
}

/// Into a file without a name, as it may be large.
void File::unpack_whole() {
  constexpr std::uint64_t content = head_size + 8;
  constexpr std::size_t piece = 1 << 18;
  const std::string head = read(0, content);
  Cursor cursor(*this, head, 0, "head");
  cursor.byte();
  if (cursor.u64() == 0) fail("unfinished: its writer was still packing it", 0);
  const std::uint64_t size = cursor.u64();
  unpacked_.reset(std::tmpfile());
  const int copy = ::dup(descriptor_);
  const auto no_room = [&] {
    throw InputError("trace '" + path_.string() +
                     "': it is packed, and there is no room to unpack it in the folder for "
                     "temporary files (TMPDIR)");
  };
  if (!unpacked_ || copy < 0) no_room();
  ::lseek(copy, static_cast<off_t>(content), SEEK_SET);
  const gzFile stream = ::gzdopen(copy, "rb");
  std::string buffer(piece, '\0');
  std::uint64_t done = 0;
  bool written = true;
  while (done < size && written) {
    const auto wanted = static_cast<unsigned>(std::min<std::uint64_t>(piece, size - done));
    const int count = ::gzread(stream, buffer.data(), wanted);
    if (count <= 0) break;
    written = std::fwrite(buffer.data(), 1, static_cast<std::size_t>(count), unpacked_.get()) ==
              static_cast<std::size_t>(count);
    done += static_cast<std::uint64_t>(count);
  }
  ::gzclose(stream);
  if (!written || std::fflush(unpacked_.get()) != 0) no_room();
  if (done != size) {
    unpacked_.reset();
    fail("truncated or corrupt: what is packed cannot be unpacked", content);
  }
  descriptor_ = ::fileno(unpacked_.get());
  size_ = size;
}

void File::read_header() {
  const std::string bytes = read(0, header_size);
  Cursor cursor(*this, bytes, 0, "header");
  cursor.byte();
  if (cursor.u64() != header_size - 1) fail("no FST: its header has another length", 1);
  cursor.u64();  // start
  end_time_ = cursor.u64();
  double order = 0;
  std::memcpy(&order, bytes.data() + cursor.consumed(), sizeof order);
  if (order != byte_order) {
    std::uint64_t other = 0;
    std::memcpy(&other, bytes.data() + cursor.consumed(), sizeof other);
    other = __builtin_bswap64(other);
    std::memcpy(&order, &other, sizeof order);
    swapped_ = true;
    if (order != byte_order) fail("no FST: its header is corrupt", cursor.offset());
  }
  constexpr std::size_t timescale_at = 73;
  const int exponent = static_cast<unsigned char>(bytes[timescale_at]);
  timescale_ = exponent < 0x80 ? exponent : exponent - 0x100;  // a signed byte
}

void File::read_blocks() {
  bool has_header = false;
  for (std::uint64_t at = 0; at < size_;) {
    if (size_ - at < head_size) fail("truncated in the block", at);
    const std::string head = read(at, head_size);
    Cursor cursor(*this, head, at, "block");
    const auto type = static_cast<Block>(cursor.byte());
    const std::uint64_t length = cursor.u64();
    if (type > values_aliases_signed && type != unfinished) {
      fail("no FST block: the file is corrupt, or no FST", at);
    }
    if (has_header && type == unfinished && length == 0) {
      finished_ = false;
      break;
    }
    if (length < 8 || length > size_ - at - 1) {
      fail("a block should be " + std::to_string(length) + " bytes long, but " +
               std::to_string(size_ - at - 1) + " follow: the file is truncated or corrupt",
           at);
    }
    if (has_header != (type != header)) fail("no FST: a header must come first, and once", at);
    const Section section{type, at + head_size, length - 8};
    if (type == header) {
      read_header();
      has_header = true;
    } else if (type == values || type == values_aliases || type == values_aliases_signed) {
      changes_.push_back(section);
    } else if (type == Block::geometry) {
      geometry_ = section;
    } else if (type == hierarchy_gzip || type == hierarchy_lz4 || type == hierarchy_lz4_twice) {
      hierarchy_ = section;
    }
    at += 1 + length;
  }
  if (!has_header) fail("truncated: no FST has so few bytes", size_);
}

std::string File::lz4(const Section& section) const {
  const std::string bytes = read(section.at, section.size);
  Cursor cursor(*this, bytes, section.at, "hierarchy");
  const std::uint64_t size = cursor.u64();
  const bool twice = section.type == hierarchy_lz4_twice;
  const std::uint64_t between = twice ? cursor.varint() : 0;
  const std::string_view packed = std::string_view(bytes).substr(cursor.consumed());
  const std::uint64_t most = most_unpacked('4', packed.size());
  std::string result;
  bool good = (twice ? between : size) <= most && (!twice || size <= most_unpacked('4', between));
  if (good && twice) {
    std::string once(between, '\0');
    result.resize(size);
    good = unpack('4', packed, once.data(), once.size()) &&
           unpack('4', once, result.data(), result.size());
  } else if (good) {
    result.resize(size);
    good = unpack('4', packed, result.data(), result.size());
  }
  if (!good) fail("the hierarchy cannot be unpacked: the file is corrupt", section.at);
  return result;
}

std::string File::hierarchy() const {
  if (hierarchy_.size == 0) {
    const std::filesystem::path beside = path_.string() + ".hier";
    std::error_code ignored;
    if (!std::filesystem::exists(beside, ignored)) {
      throw InputError("trace '" + path_.string() +
                       "': its names are missing: the writer did not finish it, and '" +
                       beside.string() + "', where they are until then, is not there");
    }
    constexpr std::uint64_t largest = std::uint64_t{1} << 30;
    return read_text(beside, "names of a trace", largest);
  }
  if (hierarchy_.type != hierarchy_gzip) return lz4(hierarchy_);
  if (hierarchy_.size < 8) fail("the hierarchy is truncated: the file is corrupt", hierarchy_.at);
  const std::string size = read(hierarchy_.at, 8);
  Cursor cursor(*this, size, hierarchy_.at, "hierarchy");
  const std::uint64_t packed = hierarchy_.size - 8, unpacked = cursor.u64();
  const std::string bytes = read(hierarchy_.at + 8, packed);
  std::string result;
  const bool good = unpacked <= most_unpacked('Z', packed);
  if (good) result.resize(unpacked);
  if (!good || !unpack('Z', bytes, result.data(), result.size())) {
    cursor.fail("cannot be unpacked");
  }
  return result;
}

std::vector<std::uint32_t> File::geometry() const {
  if (geometry_.size == 0) return {};
  if (geometry_.size < 16) fail("the sizes are truncated: the file is corrupt", geometry_.at);
  const std::string head = read(geometry_.at, 16);
  Cursor numbers(*this, head, geometry_.at, "sizes");
  const std::uint64_t unpacked = numbers.u64(), handles = numbers.u64();
  const std::string bytes = read_packed(geometry_.at + 16, geometry_.size - 16, unpacked);
  if (handles > bytes.size()) numbers.fail("are fewer than there are signals");
  Cursor cursor(*this, bytes, geometry_.at + 16, "sizes");
  std::vector<std::uint32_t> sizes;
  sizes.reserve(handles);
  for (std::uint64_t i = 0; i < handles; ++i) {
    sizes.push_back(static_cast<std::uint32_t>(cursor.varint()));
  }
  return sizes;
}

}  // namespace vp::fst
