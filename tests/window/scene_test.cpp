#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "window_run.hpp"

namespace quadrille {
namespace {

/// A hundred boxes; the column of a scene without a comment has its controls at places that are
/// known.
constexpr const char* crowdScene = R"(format = 1
name = "crowd"
[world]
size = [200, 100]
[[spawn]]
pattern = "lattice"
count = 100
size = [2, 2]
speed = [10, 20]
)";
constexpr int seedY = 126, countY = 148, gravityY = 170, restitutionY = 192, fieldX = 100;

/// Which scene is run, and the numbers that it is run with.
class WindowScene : public WindowTest {
  protected:
    void startCrowd() {
        startPaused(write("crowd.toml", crowdScene), {"--json", file("run.json")});
        screen_->press("period");
        ASSERT_TRUE(titleHas("crowd, step 1,"));
    }
    Json summary() {
        close();
        return parseJson(contentOf(path("run.json")));
    }
    /// Panels take and leave the keyboard from one picture to the next.
    static void waitForPanels() { std::this_thread::sleep_for(std::chrono::milliseconds(700)); }
    void type(int y, const std::string& digits) {
        screen_->click(fieldX, y);
        waitForPanels();
        for (const char digit : digits) screen_->press(std::string(1, digit));
        screen_->press("Return");
        EXPECT_TRUE(titleHas("crowd, step 0"));
        waitForPanels();
    }
};

TEST_F(WindowScene, ItOpensWhereSomethingHappens) {
    start({"--paused"});
    EXPECT_TRUE(titleHas("gap, step 0")) << program_->err();
    close();
    EXPECT_EQ(summaryOf({"--frames", "0"})["scene"], "balanced");
}

TEST_F(WindowScene, KeysGoThroughTheList) {
    start({"--scene", "cradle", "--paused", "--law", "impulse", "--json", file("run.json")});
    ASSERT_TRUE(titleHas("cradle, step 0")) << program_->err();
    screen_->focus();
    screen_->press("bracketright");
    EXPECT_TRUE(titleHas("demo13k, step 0"));
    screen_->press("bracketleft");
    EXPECT_TRUE(titleHas("cradle, step 0"));
    EXPECT_EQ(summary()["law"], "impulse") << "that of now, since the scene names none";
}

TEST_F(WindowScene, ASceneThatNamesItsLawIsRunWithIt) {
    start({"--scene", "cradle", "--paused", "--law", "impulse", "--json", file("run.json")});
    ASSERT_TRUE(titleHas("cradle, step 0")) << program_->err();
    screen_->focus();
    screen_->press("bracketleft");
    EXPECT_TRUE(titleHas("bullet, step 0"));
    EXPECT_EQ(summary()["law"], "continuous");
}

TEST_F(WindowScene, SeedAndCountStartAnew) {
    startCrowd();
    type(countY, "64");
    screen_->press("period");
    ASSERT_TRUE(titleHas("crowd, step 1,"));
    type(seedY, "23");
    const Json run = summary();
    EXPECT_EQ(run["seed"], 23);
    EXPECT_EQ(run["entities"], 64);
}

TEST_F(WindowScene, GravityAndRestitutionChangeLiveAndStay) {
    startCrowd();
    screen_->click(fieldX, restitutionY);
    waitForPanels();
    screen_->drag(40, gravityY, 80, gravityY, Process::Seconds(0.3));
    waitForPanels();
    screen_->press("r");
    ASSERT_TRUE(titleHas("step 0"));
    const Json run = summary();
    EXPECT_NEAR(run["restitution"].get<double>(), 0.5, 0.05);
    EXPECT_GT(run["gravity"][0].get<double>(), 20);
    EXPECT_EQ(run["gravity"][1], 0);
}

/// The window shows what each scene says of itself.
TEST_F(WindowScene, EveryShippedSceneBeginsWithASentence) {
    for (const auto& entry :
         std::filesystem::directory_iterator(shippedScene("gap").parent_path())) {
        if (entry.path().extension() != ".toml") continue;
        std::ifstream in(entry.path());
        std::string comment;
        for (std::string line; std::getline(in, line) && line.starts_with("# ");) {
            comment += line.substr(1);
        }
        const std::size_t end = comment.find('.');
        ASSERT_NE(end, std::string::npos) << entry.path();
        EXPECT_LT(end, 110u) << entry.path() << comment.substr(0, end);
    }
}

TEST_F(WindowScene, TheErrorIsPlottedLive) {
    startPaused(write("crowd.toml", crowdScene), {"--error", "--law", "impulse"});
    constexpr Rgb found{130, 214, 150}, wrong{255, 150, 128};
    const auto has = [&](const Rgb& color) {
        const Image image = screen_->image();
        int count = 0;
        for (int y = 400; y < height; ++y) {
            for (int x = 0; x < panelWidth; ++x) count += near(image.at(x, y), color);
        }
        return count > 40;
    };
    EXPECT_FALSE(has(found));
    for (int i = 0; i < 10; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 10,"));
    EXPECT_TRUE(eventually([&] { return has(found); }));
    EXPECT_TRUE(has(wrong));
    close();
}

}  // namespace
}  // namespace quadrille
