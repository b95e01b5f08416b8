#include "app/window/system_font.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace quadrille::app {
namespace {

namespace fs = std::filesystem;

class SystemFont : public testing::Test {
  protected:
    SystemFont() { fs::create_directories(folder_); }
    ~SystemFont() override { fs::remove_all(folder_); }

    void put(const std::string& file) const {
        fs::create_directories((folder_ / file).parent_path());
        std::ofstream(folder_ / file) << "a font";
    }
    fs::path find() const { return findFont({folder_ / "none", folder_}); }

    fs::path folder_ = fs::temp_directory_path() /
                       ("quadrille-font-" +
                        std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(SystemFont, IsNoneWhereNoneIsKnown) {
    EXPECT_EQ(find(), fs::path());
    put("truetype/dejavu/DejaVuSansMono.ttf");
    fs::create_directories(folder_ / "DejaVuSans.ttf");
    EXPECT_EQ(find(), fs::path());
}

TEST_F(SystemFont, LiesWhereDistributionsPutIt) {
    put("truetype/liberation2/LiberationSans-Regular.ttf");
    EXPECT_EQ(find(), folder_ / "truetype/liberation2/LiberationSans-Regular.ttf");
    put("dejavu-sans-fonts/DejaVuSans.ttf");
    EXPECT_EQ(find(), folder_ / "dejavu-sans-fonts/DejaVuSans.ttf");
}

}  // namespace
}  // namespace quadrille::app
