// Files that are being written: their names, who holds them, what becomes of those that nobody holds; links; streams.
#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/byte_stream.h>
#include <brushfire/io/unfinished.h>
#include <brushfire/io/write_bytes.h>

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <vector>

#include "io_support.h"

namespace brushfire {
namespace {

namespace fs = std::filesystem;
using test::TemporaryDirectory;

std::vector<std::string> names_in(const TemporaryDirectory& dir) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(dir.path())) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// A child that writes the file again and again.
pid_t start_writer(const std::string& path) {
  const pid_t child = fork();
  if (child != 0) return child;
  const std::string big(std::size_t{1} << 22, 'x');
  while (true) write_text(path, big);
}

// Stops the child while it writes a temporary of `target`; the name of it. An empty one it may not hold yet.
std::string stop_in_the_midst(pid_t child, const TemporaryDirectory& dir, const std::string& target) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < end) {
    kill(child, SIGSTOP);
    int status = 0;
    waitpid(child, &status, WUNTRACED);
    for (const std::string& name : names_in(dir)) {
      if (name.starts_with(target + ".part-") && fs::file_size(dir / name) > 0) return name;
    }
    kill(child, SIGCONT);
    std::this_thread::sleep_for(std::chrono::microseconds(200 + std::rand() % 500));
  }
  return "";
}

TEST(Unfinished, WhatAKilledProcessLeavesIsClearedByTheNextWriterOfTheSameFileOnly) {
  const TemporaryDirectory dir;
  for (const char* name : {"a.txt.part-abc123", "a.txt.part-000000", "b.txt.part-abc123", "a.txt.part-abc12",
                           "a.txt.part-abcxyz", "a.txt.part-abc1234", "xa.txt.part-abc123"}) {
    test::write_file(dir / name, "left over");
  }
  fs::create_directory(dir / "a.txt.part-aaaaaa");
  fs::create_symlink(dir / "b.txt.part-abc123", dir / "a.txt.part-bbbbbb");
  write_text(dir / "a.txt", "new");
  EXPECT_EQ(names_in(dir), (std::vector<std::string>{"a.txt", "a.txt.part-aaaaaa", "a.txt.part-abc12",
                                                     "a.txt.part-abc1234", "a.txt.part-abcxyz", "a.txt.part-bbbbbb",
                                                     "b.txt.part-abc123", "xa.txt.part-abc123"}));
  EXPECT_EQ(test::read_file(dir / "a.txt"), "new");
}

TEST(Unfinished, AFileThatAnotherProcessIsWritingIsLeftAloneUntilThatIsKilled) {
  const TemporaryDirectory dir;
  const std::string target = dir / "a.txt";
  const pid_t child = start_writer(target);
  const std::string held = stop_in_the_midst(child, dir, "a.txt");
  ASSERT_FALSE(held.empty());
  write_text(target, "mine");
  EXPECT_TRUE(fs::exists(dir / held)) << "it belongs to a living process";
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(fs::exists(dir / held));
  write_text(target, "mine again");
  EXPECT_FALSE(fs::exists(dir / held)) << "nobody holds it any more";
}

TEST(Unfinished, TheyAreRemovedForWhoMustEndTheProcess) {
  const TemporaryDirectory dir;
  const pid_t child = fork();
  if (child == 0) {
    std::thread([&] {
      const std::string big(std::size_t{1} << 20, 'x');
      while (true) write_text(dir / "a.txt", big);
    }).detach();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    remove_unfinished_files();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  for (const std::string& name : names_in(dir)) EXPECT_FALSE(name.starts_with("a.txt.part-")) << name;
}

TEST(Unfinished, ALinkThatLeadsNowhereIsFollowed) {
  const TemporaryDirectory dir;
  fs::create_directory(dir / "there");
  fs::create_symlink("there/real.txt", dir / "link.txt");
  fs::create_symlink(dir / "link.txt", dir / "second.txt");
  write_text(dir / "second.txt", "content");
  EXPECT_TRUE(fs::is_symlink(dir / "link.txt"));
  EXPECT_TRUE(fs::is_symlink(dir / "second.txt"));
  EXPECT_EQ(test::read_file(dir / "there/real.txt"), "content");
  fs::create_symlink("missing/real.txt", dir / "lost.txt");
  EXPECT_EQ(test::error_of([&] { write_text(dir / "lost.txt", "content"); }),
            "file_not_writable: " + (dir / "lost.txt") + ": cannot be created: No such file or directory");
  EXPECT_TRUE(fs::is_symlink(dir / "lost.txt"));
  fs::create_symlink("round.txt", dir / "round.txt");
  EXPECT_NE(test::error_of([&] { write_text(dir / "round.txt", "content"); }), "");
  EXPECT_TRUE(fs::is_symlink(dir / "round.txt"));
}

TEST(Unfinished, ANameWithAZeroByteIsNoFilesName) {
  const TemporaryDirectory dir;
  test::write_file(dir / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string name = (dir / "a.obj") + std::string("\0.obj", 5);
  EXPECT_NE(test::error_of([&] { read_mesh(name); }).find("zero byte"), std::string::npos);
  EXPECT_NE(test::error_of([&] { write_text(name, "x"); }).find("zero byte"), std::string::npos);
  EXPECT_EQ(test::read_file(dir / "a.obj").size(), 32u);
}

// ---- what a mesh file refers to

std::string gltf(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
         uri + R"("}]})";
}

TEST(Companions, ALinkLeadsNowhereOutOfTheFolder) {
  const TemporaryDirectory dir;
  fs::create_directories(dir / "model/below");
  const std::string data(36, '\0');
  test::write_file(dir / "secret.bin", data);
  test::write_file(dir / "model/below/ok.bin", data);
  fs::create_symlink("../secret.bin", dir / "model/out.bin");
  fs::create_symlink("below/ok.bin", dir / "model/in.bin");
  fs::create_directory_symlink("..", dir / "model/up");
  fs::create_directory_symlink("model", dir / "entry");
  const auto error = [&](const std::string& folder, const std::string& uri) {
    test::write_file(dir / "model/a.gltf", gltf(uri));
    return test::error_of([&] { read_mesh(dir / (folder + "/a.gltf")); });
  };
  for (const char* folder : {"model", "entry"}) {
    EXPECT_EQ(error(folder, "in.bin"), "");
    EXPECT_EQ(error(folder, "below/ok.bin"), "");
    for (const char* uri : {"out.bin", "up/secret.bin", "up/model/below/ok.bin/../ok.bin"}) {
      EXPECT_NE(error(folder, uri).find("folder"), std::string::npos) << uri;
    }
  }
  EXPECT_NE(error("model", "out.bin").find("a symbolic link that leads out of its folder"), std::string::npos);
  EXPECT_NE(error("model", "below/ok.bin%00").find("which is not in its own folder or below"), std::string::npos);
  EXPECT_NE(error("model", "none.bin").find("no such file"), std::string::npos);
}

// ---- streams

TEST(Streams, AWaitForAPipeEndsWhenTheTokenIsSet) {
  const TemporaryDirectory dir;
  ASSERT_EQ(mkfifo((dir / "pipe").c_str(), 0600), 0);
  CancelToken token;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    token.cancel();
  });
  const CancelScope listen(&token);
  EXPECT_EQ(test::error_of([&] {
              ByteStream stream(dir / "pipe", ByteStream::NamedPipes::Read);
              char c = 0;
              stream.read(&c, 1);
            }),
            "cancelled: cancelled");
  later.join();
  EXPECT_EQ(test::error_of([&] { write_text(dir / "pipe", "x"); }), "cancelled: cancelled");
}

TEST(Streams, APipeIsReadToItsEndHoweverSlowlyItComes) {
  const TemporaryDirectory dir;
  ASSERT_EQ(mkfifo((dir / "pipe").c_str(), 0600), 0);
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(80));
    write_text(dir / "pipe", std::string(300000, 'a') + "b");
  });
  ByteStream stream(dir / "pipe", ByteStream::NamedPipes::Read);
  std::string all(400000, '\0');
  std::size_t size = 0;
  while (const std::size_t got = stream.read(all.data() + size, all.size() - size)) size += got;
  writer.join();
  EXPECT_EQ(size, 300001u);
  EXPECT_EQ(all[300000], 'b');
}

}  // namespace
}  // namespace brushfire
