#include <host/digest.h>

#include <openssl/evp.h>
#include <vp/error.h>
#include <vp/file.h>

#include <array>
#include <memory>
#include <stdexcept>

namespace platform::host {

namespace {

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    check(context_ != nullptr && EVP_DigestInit_ex(context_.get(), sha_256(), nullptr) == 1);
  }

  void add(std::string_view bytes) {
    check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }

  std::string digits() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned size = 0;
    check(EVP_DigestFinal_ex(context_.get(), bytes.data(), &size) == 1);
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += "0123456789abcdef"[bytes[i] >> 4];
      text += "0123456789abcdef"[bytes[i] & 15];
    }
    return text;
  }

 private:
  /// Looked up once: EVP_sha256() is, for each digest.
  static const EVP_MD* sha_256() {
    static const std::unique_ptr<EVP_MD, decltype(&EVP_MD_free)> found(
        EVP_MD_fetch(nullptr, "SHA256", nullptr), EVP_MD_free);
    check(found != nullptr);
    return found.get();
  }

  static void check(bool ok) {
    if (!ok) throw std::runtime_error("SHA-256 is not available");
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string content_hash(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.digits();
}

std::string file_hash(const std::string& path) {
  vp::InputFile file(path, "file");
  // What is hashed is read once more, to be used.
  if (!file.is_regular())
    throw vp::InputError("'" + path + "' is a pipe, which can be read only once: name a file");
  const auto deadline = vp::InputFile::HostClock::now() + vp::InputFile::patience;
  Digest digest;
  std::array<char, 1 << 16> block;
  while (const std::size_t count = file.read(block.data(), block.size(), deadline))
    digest.add({block.data(), count});
  return digest.digits();
}

}  // namespace platform::host
