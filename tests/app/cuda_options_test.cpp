#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include <quadrille/device.hpp>

#include "program.hpp"

namespace quadrille {
namespace {

const Arguments shortRun = {"--headless", "--scene", "cradle", "--frames", "3"};

TEST(CudaOptions, BlockSizesThatCannotBeAreRefused) {
    for (const char* size : {"0", "31", "48", "1056", "-32", "128x", ""}) {
        expectRefusal(shortRun + Arguments{"--block-size", size}, 2, {"--block-size"});
    }
}

TEST(CudaOptions, AnUnknownThreadListsTheValidOnes) {
    expectRefusal(shortRun + Arguments{"--cuda-thread", "pair"}, 2,
                  {"--cuda-thread", "pair", "cell", "body"});
}

TEST(CudaOptions, ChangeNothingInTheState) {
    const Arguments wanted = shortRun + Arguments{"--resolver", "cuda", "--json", "-"};
    const auto hash = [](const Arguments& arguments) {
        const ProcessResult result = runProgram(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return parseJson(result.out)["state_hash"].get<std::string>();
    };
    EXPECT_EQ(hash(wanted + Arguments{"--block-size", "32", "--cuda-thread", "cell"}),
              hash(shortRun + Arguments{"--resolver", "sequential", "--json", "-"}));
}

TEST(CudaOptions, TheReasonForAFallbackIsTold) {
    const CudaDevice device = findCudaDevice();
    if (device.usable()) GTEST_SKIP() << "there is a device";
    const ProcessResult result =
        runProgram(shortRun + Arguments{"--law", "impulse", "--resolver", "cuda"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(contains(result.err, device.reason)) << result.err;
}

TEST(Cuda, AutoTakesADeviceForManyBodiesOnly) {
    const CudaDevice device = findCudaDevice();
    if (!device.usable()) GTEST_SKIP() << device.reason;
    const auto resolverOf = [](const char* entities, const char* law) {
        const ProcessResult result =
            runProgram({"--headless", "--scene", "balanced", "--entities", entities, "--law", law,
                        "--frames", "3", "--json", "-"});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return parseJson(result.out)["resolver"].get<std::string>();
    };
    EXPECT_EQ(resolverOf("1000", "impulse"), "sequential");
    EXPECT_EQ(resolverOf("100000", "impulse"), "cuda");
    EXPECT_NE(resolverOf("30000", "continuous"), "cuda");
}

TEST(CudaOptions, TheLawContinuousRunsSequentially) {
    const Arguments wanted = shortRun + Arguments{"--resolver", "cuda", "--law", "continuous"};
    const ProcessResult result = runProgram(wanted + Arguments{"--json", "-"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(contains(result.err, "continuous")) << result.err;
    const Json summary = parseJson(result.out);
    EXPECT_EQ(summary["resolver"], "sequential");
    EXPECT_EQ(summary["requested_resolver"], "cuda");
    EXPECT_TRUE(summary["device"].is_null());
    expectRefusal(wanted + Arguments{"--no-fallback"}, 2, {"cuda", "continuous"});
}

}  // namespace
}  // namespace quadrille
