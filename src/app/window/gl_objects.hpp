#pragma once

#include <epoxy/gl.h>
#include <utility>

namespace quadrille::app {

/// An OpenGL object that is deleted with its owner; the context must still be there.
template <void (*make)(GLuint*), void (*destroy)(GLuint)>
class GlObject {
  public:
    GlObject() { make(&id_); }
    ~GlObject() {
        if (id_ != 0) destroy(id_);
    }
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

namespace gl {
inline void makeBuffer(GLuint* id) { glGenBuffers(1, id); }
inline void destroyBuffer(GLuint id) { glDeleteBuffers(1, &id); }
inline void makeVertexArray(GLuint* id) { glGenVertexArrays(1, id); }
inline void destroyVertexArray(GLuint id) { glDeleteVertexArrays(1, &id); }
inline void makeProgram(GLuint* id) { *id = glCreateProgram(); }
inline void destroyProgram(GLuint id) { glDeleteProgram(id); }
}  // namespace gl

using GlBuffer = GlObject<gl::makeBuffer, gl::destroyBuffer>;
using GlVertexArray = GlObject<gl::makeVertexArray, gl::destroyVertexArray>;

/// A linked shader program.
class GlProgram {
  public:
    /// GLSL sources without their #version line. Throws Error with the driver's text.
    GlProgram(const char* vertexSource, const char* fragmentSource);

    void use() const { glUseProgram(program_.id()); }
    /// Throws Error if the program has no such uniform.
    GLint uniform(const char* name) const;

  private:
    GlObject<gl::makeProgram, gl::destroyProgram> program_;
};

/// An attribute that advances once an instance, read from the bound GL_ARRAY_BUFFER.
void instanceAttribute(GLuint location, GLint components, GLenum type, bool normalized,
                       GLsizei stride = 0, std::size_t offset = 0);

}  // namespace quadrille::app
