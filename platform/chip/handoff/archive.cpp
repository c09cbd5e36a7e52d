#include <chip/handoff/archive.h>

#include <vp/error.h>
#include <vp/text.h>
#include <zip.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace platform::handoff {

namespace {

constexpr zip_int64_t most_members = 10'000;  // the largest seen has some 500

/// A path that stays in the folder of the archive.
bool is_inside(const std::string& name) {
  if (name.empty() || name.front() == '/' || name.find('\\') != std::string::npos) return false;
  const std::vector<std::string> parts = vp::split(name, '/');
  return std::find(parts.begin(), parts.end(), "..") == parts.end();
}

}  // namespace

bool Archive::is_archive(const std::string& bytes) {
  return bytes.rfind("PK\x03\x04", 0) == 0 || bytes.rfind("PK\x05\x06", 0) == 0;
}

Archive::Archive(std::string bytes, std::string origin)
    : bytes_(std::move(bytes)), origin_(std::move(origin)) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes_.data(), bytes_.size(), 0, &error);
  // Not ZIP_CHECKCONS: Vivado up to 2018 writes headers that contradict each other. Check sums are
  // compared all the same.
  zip_.reset(source ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr);
  if (!zip_) {
    if (source) zip_source_free(source);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    fail("is a damaged archive (" + reason + "): export it again");
  }
  zip_error_fini(&error);
  const zip_int64_t count = zip_get_num_entries(zip_.get(), 0);
  if (count > most_members)
    fail("has " + std::to_string(count) + " members, 10000 at most are read");
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* name = zip_get_name(zip_.get(), static_cast<zip_uint64_t>(i), 0);
    if (!name || !is_inside(name)) {
      fail("has the member '" + vp::excerpt(vp::visible(name ? name : "")) +
           "', which leaves its folder: this is no archive of Vivado's");
    }
    names_.emplace_back(name);
  }
}

void Archive::Close::operator()(zip* opened) const {
  zip_discard(opened);
}

bool Archive::has(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::string Archive::read(const std::string& name) const {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat(zip_.get(), name.c_str(), 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE))
    fail("has no member '" + vp::excerpt(vp::visible(name)) + "'");
  if (stat.size > largest_member)
    fail("has a member '" + name + "' of " + std::to_string(stat.size) + " bytes: too large");
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(
      zip_fopen(zip_.get(), name.c_str(), 0), &zip_fclose);
  if (!file) fail("cannot be read at '" + name + "' (" + zip_strerror(zip_.get()) + ")");
  std::string text(stat.size, '\0');
  const zip_int64_t read = zip_fread(file.get(), text.data(), text.size());
  // libzip compares the check sum where a read finds the end, and only there.
  char more = 0;
  if (read < 0 || static_cast<zip_uint64_t>(read) != stat.size ||
      zip_fread(file.get(), &more, 1) != 0)
    fail("is damaged at '" + name + "' (" + zip_file_strerror(file.get()) + "): export it again");
  return text;
}

void Archive::fail(const std::string& problem) const {
  throw vp::InputError("'" + origin_ + "' " + problem);
}

}  // namespace platform::handoff
