#include "core/render/gl_context.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

std::string FindMessage(const std::string& library) {
  try {
    GlContext context(library);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kEnvironment);
    return error.what();
  }
  return "no error";
}

TEST(GlContextTest, NamesThePackageOfAMissingLibrary) {
  EXPECT_EQ(FindMessage("libNoSuchMesa.so.8"),
            "pictures need the off-screen renderer OSMesa, which cannot be loaded "
            "(libNoSuchMesa.so.8: cannot open shared object file: No such file or directory); "
            "install the Debian package libosmesa6");
}

TEST(GlContextTest, RefusesALibraryThatIsNotOsMesa) {
  EXPECT_EQ(FindMessage("libpng16.so.16"),
            "\"libpng16.so.16\" has no function OSMesaCreateContextAttribs; expected OSMesa 22 of "
            "the Debian package libosmesa6");
}

TEST(GlContextTest, TwoContextsLiveSideBySide) {
  GlContext first;
  GlContext second;
  GLuint buffer = 0;
  first.MakeCurrent();
  first.functions().GenBuffers(1, &buffer);
  EXPECT_EQ(buffer, 1u);
  second.MakeCurrent();
  second.functions().GenBuffers(1, &buffer);
  EXPECT_EQ(buffer, 1u);  // its own names
  EXPECT_EQ(second.functions().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace graspbench
