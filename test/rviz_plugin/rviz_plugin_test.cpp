// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What rviz does before it shows a display: find the class by its name and load its library.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <mvo/MotionArray.h>
#include <rviz/display.h>

#include <filesystem>
#include <fstream>
#include <pluginlib/class_loader.hpp>
#include <sstream>

namespace {

const std::string kClass = "mvo/MotionArray";  // NOLINT(bugprone-dynamic-static-initializers)

class RvizPlugin : public testing::Test {
 protected:
  pluginlib::ClassLoader<rviz::Display> loader_{"rviz", "rviz::Display"};
};

TEST_F(RvizPlugin, TheClassIsFoundWithItsMessage) {
  ASSERT_TRUE(loader_.isClassAvailable(kClass));
  EXPECT_EQ(loader_.getClassPackage(kClass), "mvo");
  EXPECT_FALSE(loader_.getClassDescription(kClass).empty());
  // rviz proposes the display for topics of the type that the description names.
  std::ifstream file(loader_.getPluginManifestPath(kClass));
  std::stringstream description;
  description << file.rdbuf();
  const std::string type = ros::message_traits::datatype<mvo::MotionArray>();
  EXPECT_NE(description.str().find("<message_type>" + type + "</message_type>"), std::string::npos);
}

TEST_F(RvizPlugin, TheBuiltLibraryResolvesEverySymbol) {
  ASSERT_TRUE(loader_.isClassAvailable(kClass));
  const std::string library = loader_.getClassLibraryPath(kClass);
  EXPECT_TRUE(std::filesystem::equivalent(library, MVO_RVIZ_LIBRARY)) << library;
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(handle, nullptr) << dlerror();
  dlclose(handle);
}

TEST_F(RvizPlugin, LoadingRegistersTheClass) {
  ASSERT_NO_THROW(loader_.loadLibraryForClass(kClass));
  EXPECT_TRUE(loader_.isClassLoaded(kClass));
}

}  // namespace
