// What files are written and read by: the same calls mean the same on every system, Windows included.
#include <brushfire/io/detail/posix.h>

#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "io_support.h"

namespace posix = brushfire::detail::posix;

namespace {

class Posix : public testing::Test {
 protected:
  const brushfire::test::TemporaryDirectory folder_;
  const std::string name_ = folder_ / "gr\xc3\xbc\xc3\x9f.part", other_ = folder_ / "gr\xc3\xbc\xc3\x9f.txt";
};

int made(const std::string& name) { return posix::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666); }

TEST_F(Posix, NamesAreTakenOnceAndLocksByOne) {
  const int mine = made(name_);
  ASSERT_GE(mine, 0);
  EXPECT_LT(made(name_), 0);
  EXPECT_EQ(errno, EEXIST);
  const int theirs = posix::open(name_.c_str(), O_RDONLY);
  EXPECT_EQ(posix::flock(mine, LOCK_EX | LOCK_NB), 0);
  EXPECT_NE(posix::flock(theirs, LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(errno, EWOULDBLOCK);

  // Who has no lock reads all the same, and bytes as they are.
  char text[8] = {};
  EXPECT_EQ(posix::write(mine, "a\nb\n", 4), 4);
  EXPECT_EQ(posix::read(theirs, text, sizeof text), 4);
  EXPECT_STREQ(text, "a\nb\n");
  EXPECT_EQ(posix::read(theirs, text, sizeof text), 0);
  posix::close(mine);
  posix::close(theirs);
}

TEST_F(Posix, OpenFilesAreRenamedOverOthersAndRemoved) {
  const int file = made(name_);
  posix::close(made(other_));
  struct posix::stat open{}, named{};
  EXPECT_EQ(posix::rename(name_.c_str(), other_.c_str()), 0);
  EXPECT_NE(posix::stat(name_.c_str(), &named), 0);
  EXPECT_EQ(errno, ENOENT);
  ASSERT_EQ(posix::fstat(file, &open), 0);
  ASSERT_EQ(posix::lstat(other_.c_str(), &named), 0);
  EXPECT_EQ(open.st_ino, named.st_ino);
  EXPECT_EQ(open.st_dev, named.st_dev);
  EXPECT_TRUE(S_ISREG(named.st_mode));
  EXPECT_EQ(posix::unlink(other_.c_str()), 0);
  posix::close(file);
  EXPECT_NE(posix::stat(other_.c_str(), &named), 0);
}

TEST_F(Posix, BytesAreReadAndWrittenAnywhere) {
  const int file = posix::open(name_.c_str(), O_RDWR | O_CREAT, 0666);
  struct posix::stat status{};
  char text[3] = {};
  EXPECT_EQ(posix::pwrite(file, "xyz", 3, 10), 3);
  ASSERT_EQ(posix::fstat(file, &status), 0);
  EXPECT_EQ(status.st_size, 13);
  EXPECT_EQ(posix::pread(file, text, 3, 11), 2);
  EXPECT_EQ(std::memcmp(text, "yz", 2), 0);
  EXPECT_EQ(posix::pread(file, text, 3, 13), 0);
  EXPECT_EQ(posix::ftruncate(file, 5), 0);
  ASSERT_EQ(posix::fstat(file, &status), 0);
  EXPECT_EQ(status.st_size, 5);
  posix::close(file);
}

}  // namespace
