// The verb convert, --weld, and what the help says of formats.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/formats.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_lines.h>

#include <gtest/gtest.h>

namespace brushfire::test {
namespace {

class Convert : public InFolder {
 protected:
  void SetUp() override {
    write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    // The same square with a seam along its diagonal: vertices 4 and 5 all but repeat 0 and 2.
    write("seam.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1e-9 0 0\n1 1 1e-9\n3 0 1 2\n3 4 5 3\n");
  }
};

TEST_F(Convert, EveryFormatOfMeshesGoesToEveryOther) {
  for (const FileFormat& from : meshes_written()) {
    const std::string middle = path("a." + from.extensions.front());
    ASSERT_EQ(run_program({"convert", path("square.off"), middle}).code, 0) << middle;
    for (const FileFormat& to : meshes_written()) {
      const std::string last = path("b." + to.extensions.front());
      const Ended ended = run_program({"convert", middle, last});
      ASSERT_EQ(ended.code, 0) << ended.err;
      EXPECT_EQ(read_mesh(last).mesh.face_count(), 2u) << middle << " to " << last;
    }
  }
}

TEST_F(Convert, ValuesGoAloneOrWithTheirMesh) {
  write("v.txt", "0 1.5\n-2\ninf\n");
  EXPECT_EQ(run_program({"convert", path("v.txt"), path("v.npy")}).code, 0);
  EXPECT_EQ(run_program({"convert", path("v.npy"), path("v.shape.gii")}).code, 0);
  EXPECT_EQ(run_program({"convert", path("v.shape.gii"), path("v.csv")}).code, 0);
  EXPECT_EQ(content("v.csv"), "vertex,value\n0,0\n1,1.5\n2,-2\n3,inf\n");
  EXPECT_EQ(run_program({"convert", path("square.off"), path("s.ply"), "--scalar", path("v.npy")}).code, 0);
  EXPECT_EQ(read_field(path("s.ply")).values, (std::vector<double>{0, 1.5, -2, kInfinity}));
  EXPECT_EQ(run_program({"convert", path("s.ply"), path("back.csv")}).code, 0);
  EXPECT_EQ(content("back.csv"), "vertex,quality\n0,0\n1,1.5\n2,-2\n3,inf\n");
}

TEST_F(Convert, CurvesGoToDrawingsAloneAndToCurvesWithTheirMesh) {
  ASSERT_EQ(run_program({"path", path("square.off"), "--from", "1", "--to", "3", "-o", path("p.json")}).code, 0);
  for (const char* name : {"p.obj", "p.csv", "p.vtp", "p.ply"}) {
    const Ended ended = run_program({"convert", path("p.json"), path(name), "--mesh", path("square.off")});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(read_lines(path(name)).lines.at(0).positions, read_lines(path("p.json")).lines.at(0).positions) << name;
    ASSERT_EQ(run_program({"convert", path(name), path("p.dxf"), "--unit", "m"}).code, 0) << name;
    EXPECT_NE(content("p.dxf").find("\n10\n1000\n20\n0\n"), std::string::npos) << name;
  }
  EXPECT_EQ(run_program({"convert", path("p.json"), path("p.svg"), "--outline"}).code, 2);
  EXPECT_EQ(run_program({"convert", path("p.json"), path("p.svg"), "--outline", "--mesh", path("square.off")}).code, 0);
  EXPECT_NE(content("p.svg").find("id=\"outline\""), std::string::npos);
}

TEST_F(Convert, CurvesThatLieOffTheirMeshAreNotMovedWithoutAWord) {
  write("high.obj", "v 0.25 0.5 3\nv 0.75 0.5 5\nl 1 2\n");
  const Ended ended = run_program({"convert", path("high.obj"), path("p.json"), "--mesh", path("square.off")});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.err.find("2 positions are off the surface, the farthest, 'point 1', 5 from the surface"),
            std::string::npos)
      << ended.err;
  EXPECT_EQ(read_lines(path("p.json")).lines.at(0).positions, (std::vector<Vec3>{{0.25, 0.5, 0}, {0.75, 0.5, 0}}));
}

TEST_F(Convert, WhatIsNotWrittenIsAUsageErrorThatListsWhatIs) {
  const Ended ended = run_program({"convert", path("square.off"), path("a.xyz")});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("(known: ply, obj, off"), std::string::npos);
  EXPECT_NE(
      run_program({"distance", path("square.off"), "--source", "0", "-o", path("a.dscalar.nii")}).err.find("CIFTI-2"),
      std::string::npos);
}

TEST_F(Convert, InfoNamesTheWeldThatDistanceNeeds) {
  EXPECT_NE(run_program({"info", path("seam.off")}).out.find("4 boundary vertices lie within 1e-09 of another"),
            std::string::npos);
  EXPECT_NE(run_program({"info", path("seam.off"), "--weld", "1e-9"}).out.find("2 vertices joined to another"),
            std::string::npos);
  EXPECT_EQ(run_program({"distance", path("seam.off"), "--source", "1", "--target", "3"}).code, 4);
  EXPECT_EQ(run_program({"path", path("seam.off"), "--from", "1", "--to", "3", "--weld", "1e-8"}).out,
            run_program({"path", path("square.off"), "--from", "1", "--to", "3"}).out);
}

TEST_F(Convert, NumbersOfAWeldedMeshAreThoseOfTheFile) {
  const Ended ended =
      run_program({"distance", path("seam.off"), "--source", "5", "--weld", "1e-8", "-o", path("d.csv")});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::vector<double> d = read_field(path("d.csv")).values;
  ASSERT_EQ(d.size(), 6u);
  EXPECT_EQ(d[2], 0);
  EXPECT_EQ(d[5], 0);
  EXPECT_EQ(d[4], d[0]);
  EXPECT_EQ(d[1], 1);
  EXPECT_EQ(run_program({"matrix", path("seam.off"), "--rows", "4,5", "--weld", "1e-8", "-o", path("m.npy")}).code, 0);
  EXPECT_EQ(run_program({"distance", path("seam.off"), "--source", "6", "--weld", "1e-8"}).code, 2);
  EXPECT_EQ(run_program({"info", path("seam.off"), "--weld", "-1"}).code, 2);
}

TEST_F(Convert, GiftiHasOneMapUnlessTheLabelsAreAskedFor) {
  const auto maps = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"distance", path("square.off"), "--source", "0", "-o", path("d.shape.gii")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run_program(arguments).code, 0);
    const std::string text = content("d.shape.gii");
    return text.substr(text.find("NumberOfDataArrays=") + 20, 1);
  };
  EXPECT_EQ(maps({}), "1");
  EXPECT_EQ(maps({"--labels"}), "2");
}

TEST_F(Convert, HelpNamesEveryFormat) {
  for (const char* verb : {"info", "distance", "path", "isolines", "matrix", "convert"}) {
    const std::string help = run_program({verb, "--help"}).out;
    for (const FileFormat& format : meshes_read()) {
      EXPECT_NE(help.find(format.name), std::string::npos) << verb << ": " << format.name;
    }
  }
  const std::string help = run_program({"distance", "--help"}).out;
  for (const FileFormat& format : fields_written()) {
    EXPECT_NE(help.find("." + format.extensions.front()), std::string::npos) << format.name;
  }
}

TEST_F(Convert, APlaceOutOfABinaryFileIsShownAsText) {
  write("thick.gii.gz", std::string("\x1f\x8b\x08\0\xff\xfe\x01", 7) + std::string(200, '\xaa'));
  const Ended ended =
      run_program({"matrix", path("square.off"), "--columns", path("thick.gii.gz"), "-o", path("m.npy")});
  EXPECT_EQ(ended.code, 2);
  for (const char c : ended.err) EXPECT_TRUE((c >= ' ' && c < 127) || c == '\n') << ended.err;
  EXPECT_LT(ended.err.size(), 500u);
}

}  // namespace
}  // namespace brushfire::test
