/// Ten thousand made-up files of each format, whole, cut and damaged.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <ostream>
#include <string>

#include "condyle/input_error.h"
#include "condyle/mesh_files/mesh_readers.h"
#include "mesh/made_mesh.h"

namespace condyle {
namespace {

using namespace test;

struct Format {
  const char* name;
  MadeFile (*make)(Random&);
  TriangleMesh (*read)(const MeshBytes&);
};
void PrintTo(const Format& format, std::ostream* out) { *out << format.name; }

/// What came of a file: a mesh, or one line.
struct Outcome {
  std::optional<TriangleMesh> mesh;
  std::string complaint;
};

Outcome read(const Format& format, const std::string& bytes) {
  try {
    return {format.read(MeshBytes("made.up", bytes)), ""};
  } catch (const InputError& error) {
    return {std::nullopt, error.what()};
  }
}

bool is_one_line(const std::string& text) {
  return text.rfind("made.up: ", 0) == 0 && text.size() < 300 &&
         std::none_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < 32; });
}

/// Indices that name vertices, coordinates that are numbers.
bool is_sound(const TriangleMesh& mesh) {
  const int n = static_cast<int>(mesh.vertices.size());
  for (const auto& p : mesh.vertices)
    if (!p.allFinite()) return false;
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle)
      if (v < 0 || v >= n) return false;
  return !mesh.triangles.empty();
}

class MadeFiles : public ::testing::TestWithParam<Format> {};

TEST_P(MadeFiles, TenThousandReadBackEqual) {
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const MadeFile file = GetParam().make(random);
    const Outcome outcome = read(GetParam(), file.bytes);
    ASSERT_TRUE(outcome.mesh) << i << ": " << outcome.complaint << "\n" << file.bytes;
    ASSERT_EQ(difference(*outcome.mesh, file.mesh), "") << i << "\n" << file.bytes;
  }
}

/// As many vertices and faces from the beginning as the mesh has.
MadeMesh beginning(const MadeMesh& whole, const TriangleMesh& mesh) {
  MadeMesh part;
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < std::min(mesh.vertices.size(), whole.vertices.size()); ++i)
    part.vertices.push_back(whole.vertices[i]);
  for (const auto& face : whole.faces) {
    if (triangles >= mesh.triangles.size()) break;
    part.faces.push_back(face);
    triangles += face.size() - 2;
  }
  return part;
}

// A format that does not tell its end may come back smaller, but each number in it as it was.
TEST_P(MadeFiles, CutAtAnyByteAreReadEqualOrRefusedInOneLine) {
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    const MadeFile file = GetParam().make(random);
    for (std::size_t size = 0; size < file.bytes.size(); ++size) {
      const std::string bytes = file.bytes.substr(0, size);
      const Outcome outcome = read(GetParam(), bytes);
      if (!outcome.mesh)
        ASSERT_TRUE(is_one_line(outcome.complaint)) << outcome.complaint;
      else
        ASSERT_EQ(difference(*outcome.mesh,
                             file.tells_its_end ? file.mesh : beginning(file.mesh, *outcome.mesh)),
                  "")
            << size << "\n"
            << bytes;
    }
  }
}

TEST_P(MadeFiles, DamagedOnesAreSoundOrRefusedInOneLine) {
  Random random(3);
  int refused = 0;
  constexpr int kFiles = 10000;
  for (int i = 0; i < kFiles; ++i) {
    std::string bytes = GetParam().make(random).bytes;
    for (int n = pick(random, 1, 4); n > 0 && !bytes.empty(); --n) {
      const std::size_t at = random() % bytes.size();
      switch (pick(random, 0, 4)) {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes.erase(at, 1 + random() % 20);
          break;
        case 2:
          bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 20));
          break;
        case 3:
          bytes.replace(at, 1, one_of<std::string>(random, {"9", "-", "\n", "\\", "#", " ", "/"}));
          break;
        default:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << pick(random, 0, 7)));
      }
    }
    const Outcome outcome = read(GetParam(), bytes);
    refused += !outcome.mesh;
    if (outcome.mesh)
      ASSERT_TRUE(is_sound(*outcome.mesh)) << bytes;
    else
      ASSERT_TRUE(is_one_line(outcome.complaint)) << outcome.complaint;
  }
  EXPECT_GT(refused, kFiles / 20);
}

INSTANTIATE_TEST_SUITE_P(All,
                         MadeFiles,
                         ::testing::Values(Format{"stl", make_stl, read_stl},
                                           Format{"ply", make_ply, read_ply},
                                           Format{"obj", make_obj, read_obj},
                                           Format{"off", make_off, read_off}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace condyle
