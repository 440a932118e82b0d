/// Result files that a stranger made: what they name outside of themselves is not followed, and what they declare is
/// not believed.

#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "condyle/input_error.h"
#include "condyle/results/digest.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/run_file.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

class ForeignHdf5 : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("condyle_foreign_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    write_run(run_, made_up_run());
    write_run(other_, made_up_run());
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// The run with one of its datasets, of three numbers, made anew by `make` (group, name).
  void replace(const char* group,
               const char* name,
               const std::function<void(hid_t, const char*)>& make) const {
    const Hdf5Handle file(H5Fopen(run_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    ASSERT_GE(file.id(), 0);
    const Hdf5Handle parent(H5Gopen2(file.id(), group, H5P_DEFAULT), H5Gclose);
    ASSERT_GE(H5Ldelete(parent.id(), name, H5P_DEFAULT), 0);
    make(parent.id(), name);
  }
  [[nodiscard]] std::string message() const {
    try {
      (void)read_run(run_);
    } catch (const InputError& error) {
      const std::string what = error.what();
      return what.starts_with(run_.string()) ? what.substr(run_.string().size()) : what;
    }
    return "no error";
  }

  fs::path folder_;
  fs::path run_ =
      fs::path(testing::TempDir()) / ("condyle_foreign_" + std::to_string(::getpid())) / "run.h5";
  fs::path other_ = run_.parent_path() / "other.h5";
};

Hdf5Handle properties(hid_t kind) { return {H5Pcreate(kind), H5Pclose}; }
Hdf5Handle space(const std::vector<hsize_t>& sizes) {
  return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose};
}
void make(hid_t group, const char* name, hid_t type, const Hdf5Handle& of, const Hdf5Handle& as) {
  const Hdf5Handle dataset(
      H5Dcreate2(group, name, type, of.id(), H5P_DEFAULT, as.id(), H5P_DEFAULT), H5Dclose);
  EXPECT_GE(dataset.id(), 0);
}

TEST_F(ForeignHdf5, LinksAreNotFollowed) {
  replace("/sweep", "value", [&](hid_t group, const char* name) {
    H5Lcreate_external(other_.c_str(), "/sweep/value", group, name, H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_EQ(message(), ": /sweep/: value is a link into another file, expected what it names");
  replace("/sweep", "value", [&](hid_t group, const char* name) {
    H5Lcreate_soft("/sweep/status", group, name, H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_EQ(message(), ": /sweep/: value is a soft link, expected what it names");
}

TEST_F(ForeignHdf5, GroupsBehindLinksAreNotFollowed) {
  replace("/", "sweep", [&](hid_t group, const char* name) {
    H5Lcreate_external(other_.c_str(), "/sweep", group, name, H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_EQ(message(), ": /: sweep is a link into another file, expected what it names");
}

/// A group that holds one that it lies in would be read without end.
TEST_F(ForeignHdf5, AGroupWithinItselfIsRefused) {
  const std::string words = " stands in the file at several places, expected a group of its own";
  replace("/sweep/joint", "flexion", [&](hid_t group, const char*) {
    H5Lcreate_hard(group, "/sweep", group, "again", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_EQ(message(), ": /: sweep" + words);
  for (const ReadBy by : {ReadBy::kThisProcess, ReadBy::kProcessOfItsOwn}) {
    const Hdf5Reader reader(run_, by);
    EXPECT_THROW((void)read_columns(reader.root()), InputError);
  }
}

TEST_F(ForeignHdf5, TheRootWithinItselfIsRefused) {
  replace("/sweep/joint", "flexion", [&](hid_t group, const char* name) {
    H5Lcreate_hard(group, "/", group, name, H5P_DEFAULT, H5P_DEFAULT);
  });
  for (const ReadBy by : {ReadBy::kThisProcess, ReadBy::kProcessOfItsOwn}) {
    const Hdf5Reader reader(run_, by);
    EXPECT_THROW((void)read_columns(reader.root()), InputError);
  }
}

/// 24 bytes of another file would be the numbers.
TEST_F(ForeignHdf5, ExternalStorageIsNotRead) {
  const std::vector<double> secret = {0.1, 0.2, 0.3};
  std::ofstream(folder_ / "secret", std::ios::binary)
      .write(reinterpret_cast<const char*>(secret.data()), 24);
  replace("/sweep", "value", [&](hid_t group, const char* name) {
    const Hdf5Handle as = properties(H5P_DATASET_CREATE);
    H5Pset_external(as.id(), (folder_ / "secret").c_str(), 0, 24);
    make(group, name, H5T_IEEE_F64LE, space({3}), as);
  });
  EXPECT_EQ(message(), ": /sweep/: dataset value lies in another file, expected its values");
}

TEST_F(ForeignHdf5, DatasetsOfOtherFilesAreNotRead) {
  replace("/sweep", "value", [&](hid_t group, const char* name) {
    const Hdf5Handle as = properties(H5P_DATASET_CREATE);
    const Hdf5Handle of = space({3});
    H5Pset_virtual(as.id(), of.id(), other_.c_str(), "/sweep/value", of.id());
    make(group, name, H5T_IEEE_F64LE, of, as);
  });
  EXPECT_EQ(message(),
            ": /sweep/: dataset value is made of datasets of other files, expected its values");
}

// Rows of nothing cost whoever keeps a list for each.
TEST_F(ForeignHdf5, ManyRowsOfNothingAreNotBelieved) {
  replace("/sweep", "value", [&](hid_t group, const char* name) {
    make(group, name, H5T_IEEE_F64LE, space({hsize_t{1} << 40, 0}), properties(H5P_DATASET_CREATE));
  });
  EXPECT_EQ(
      message(),
      ": /sweep/: dataset value declares many rows of nothing, expected rows that hold something");
}

/// 8 EB that are not there; and 2^32 * 2^32 values, whose number is 0 in 64 bits.
TEST_F(ForeignHdf5, WhatTheFileCannotHoldIsNotAllocated) {
  for (const std::vector<hsize_t>& sizes :
       {std::vector<hsize_t>{hsize_t{1} << 60}, {hsize_t{1} << 32, hsize_t{1} << 32}}) {
    replace("/sweep", "value", [&](hid_t group, const char* name) {
      const Hdf5Handle as = properties(H5P_DATASET_CREATE);
      const std::vector<hsize_t> chunk(sizes.size(), 16);
      H5Pset_chunk(as.id(), static_cast<int>(chunk.size()), chunk.data());
      make(group, name, H5T_IEEE_F64LE, space(sizes), as);
    });
    EXPECT_NE(message().find("expected no more than the 0 that it stores can hold"),
              std::string::npos)
        << message();
  }
}

/// One text of 20 kB that stands 100000 times in a file of 2 MB would be 2 GB.
TEST_F(ForeignHdf5, OneTextManyTimesIsNotRead) {
  constexpr std::size_t kTimes = 100000;
  replace("/sweep", "reason", [&](hid_t group, const char* name) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), H5T_VARIABLE);
    H5Tset_cset(type.id(), H5T_CSET_UTF8);
    const Hdf5Handle of = space({kTimes});
    const Hdf5Handle dataset(
        H5Dcreate2(group, name, type.id(), of.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose);
    const std::string text(20000, 'x');
    std::vector<const char*> texts(kTimes, nullptr);
    texts[0] = text.c_str();
    H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data());
    H5Fflush(group, H5F_SCOPE_GLOBAL);
  });
  // What stands in the file of the first text: its length, and where it is.
  std::string bytes;
  {
    std::ifstream stream(run_, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
  }
  const std::string length("\x20\x4e\x00\x00", 4);  // 20000
  std::size_t at = std::string::npos;
  for (std::size_t i = bytes.find(length); i != std::string::npos; i = bytes.find(length, i + 1))
    if (i + 16 * kTimes <= bytes.size() && bytes.find_first_not_of('\0', i + 16) >= i + 16 * kTimes)
      at = i;
  ASSERT_NE(at, std::string::npos);
  for (std::size_t i = 1; i < kTimes; ++i) bytes.replace(at + 16 * i, 16, bytes, at, 16);
  std::ofstream(run_, std::ios::binary) << bytes;
  EXPECT_EQ(message(), ": /sweep/: dataset reason cannot be read as texts");
}

/// A filter that is registered nowhere would be looked for in folders of plug-ins.
TEST_F(ForeignHdf5, PluginsAreNotLoaded) {
  constexpr H5Z_filter_t kFilter = 300;
  const auto pass = [](unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*,
                       void**) { return bytes; };
  const H5Z_class2_t filter = {H5Z_CLASS_T_VERS, kFilter, 1, 1, "made up", nullptr, nullptr, pass};
  ASSERT_GE(H5Zregister(&filter), 0);
  replace("/sweep", "value", [&](hid_t group, const char* name) {
    const Hdf5Handle as = properties(H5P_DATASET_CREATE);
    const hsize_t chunk = 3;
    H5Pset_chunk(as.id(), 1, &chunk);
    H5Pset_filter(as.id(), kFilter, H5Z_FLAG_MANDATORY, 0, nullptr);
    make(group, name, H5T_IEEE_F64LE, space({3}), as);
  });
  H5Zunregister(kFilter);
  EXPECT_EQ(message(),
            ": /sweep/: dataset value is packed by filter 300, a plug-in, expected deflate or "
            "none");
  unsigned state = 1;
  EXPECT_GE(H5PLget_loading_state(&state), 0);
  EXPECT_EQ(state, 0U);
}

/// A result file names the meshes that it was computed from: /dev/zero has no end.
TEST(DigestOfAFile, IsThatOfAPlainFile) {
  EXPECT_THROW((void)sha256_of_file("/dev/zero"), InputError);
  EXPECT_THROW((void)sha256_of_file(testing::TempDir()), InputError);
}

}  // namespace
}  // namespace condyle
