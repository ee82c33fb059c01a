#include "mdat/link/key.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const Key kMaster{std::vector<std::uint8_t>(32, 0x0B), 0};

std::string written(const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "lasso_key.txt";
  std::ofstream(file, std::ios::binary) << text;
  return file.string();
}

std::string refusal(const std::string& file) {
  try {
    static_cast<void>(load_key(file));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Key, AKeyIsReadOrRefusedInWords) {
  VERIFIES("LASSO-LNK-021~2");
  std::string digits;
  for (int i = 0; i < 32; ++i) digits += "0b";
  EXPECT_EQ(load_key(written(digits + "\n")), kMaster);
  EXPECT_EQ(load_key(written(digits + " 7\n")), (Key{kMaster.bytes, 7}));
  for (const std::string& bad : {std::string(), digits.substr(2), digits + "0b", digits.substr(1) + "g", digits.substr(3) + ":0b",
                                 digits + " ", digits + " 0", digits + " 7x", digits + " 4294967296", " " + digits}) {
    EXPECT_NE(refusal(written(bad)).find("64 hexadecimal digits are expected"), std::string::npos) << bad;
  }
  EXPECT_NE(refusal("none.key").find("none.key: no such file"), std::string::npos);
}

TEST(Key, ADerivedKeyIsNoMaster) {
  VERIFIES("LASSO-LNK-046~2");
  EXPECT_EQ(load_master_key(written(key_text(kMaster))), kMaster);
  const std::string file = written(key_text(derive_command_key(kMaster, 7)));
  try {
    static_cast<void>(load_master_key(file));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), file + ": is key 7, which signs commands alone: give the master key");
  }
}

// Independent of the code under test: by `openssl kdf -keylen 32 -kdfopt mac:HMAC -kdfopt digest:SHA256 -kdfopt hexkey:0b..0b -kdfopt
// mode:COUNTER -kdfopt salt:"3DLASSO command key" -kdfopt hexinfo:00000001 KBKDF`, and with another number, and another label.
TEST(Key, DerivedKeysAreThoseOfOpenSslOnTheCommandLine) {
  VERIFIES("LASSO-LNK-046~2");
  EXPECT_EQ(key_text(derive_command_key(kMaster, 1)), "e07385179dd66466b2cc6d6fa3b9d30a3dc67fdaf04879bdfef9862615228014 1\n");
  EXPECT_EQ(key_text(derive_command_key(kMaster, 511)), "4795bb85acff9f8db11e9982fb354e3daacf385188f99b469c46ab2d394f2154 511\n");
  EXPECT_EQ(key_text(derive_image_key(kMaster)), "2ca0e8d170418ef01a9ab19c69f220f48dafd962ec2070eda3167925c83b44fd\n");
  EXPECT_EQ(derive_command_key(kMaster, 0), kMaster);
}

TEST(Key, AKeyThatIsWrittenIsReadAgain) {
  VERIFIES("LASSO-LNK-046~2");
  const Key key = derive_command_key(kMaster, 511);
  EXPECT_EQ(load_key(written(key_text(key))), key);
}

TEST(Key, CodesAreComparedWhole) {
  VERIFIES("LASSO-LNK-021~2");
  const std::uint8_t a[] = {1, 2, 3}, b[] = {1, 2, 4};
  EXPECT_TRUE(same_code(a, a));
  EXPECT_FALSE(same_code(a, b));
  EXPECT_FALSE(same_code({}, {}));
}

}  // namespace
}  // namespace lasso::mdat
