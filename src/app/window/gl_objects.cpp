#include "app/window/gl_objects.hpp"

#include <array>
#include <string>

#include <quadrille/error.hpp>

namespace quadrille::app {

namespace {

void attachShader(GLuint program, GLenum kind, const char* source) {
    const GLuint shader = glCreateShader(kind);
    const std::array<const char*, 2> parts = {"#version 330 core\n", source};
    glShaderSource(shader, GLsizei(parts.size()), parts.data(), nullptr);
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    std::array<char, 1024> log{};
    if (compiled != GL_TRUE) glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
    glAttachShader(program, shader);
    glDeleteShader(shader);  // the program keeps it
    if (compiled != GL_TRUE) {
        throw Error("OpenGL cannot compile a shader: " + std::string(log.data()));
    }
}

}  // namespace

GlProgram::GlProgram(const char* vertexSource, const char* fragmentSource) {
    attachShader(program_.id(), GL_VERTEX_SHADER, vertexSource);
    attachShader(program_.id(), GL_FRAGMENT_SHADER, fragmentSource);
    glLinkProgram(program_.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program_.id(), GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return;
    std::array<char, 1024> log{};
    glGetProgramInfoLog(program_.id(), log.size(), nullptr, log.data());
    throw Error("OpenGL cannot link a shader program: " + std::string(log.data()));
}

GLint GlProgram::uniform(const char* name) const {
    const GLint location = glGetUniformLocation(program_.id(), name);
    if (location < 0) throw Error(std::string("a shader program has no uniform ") + name);
    return location;
}

void instanceAttribute(GLuint location, GLint components, GLenum type, bool normalized,
                       GLsizei stride, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, components, type, normalized ? GL_TRUE : GL_FALSE, stride,
                          reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(location, 1);
}

}  // namespace quadrille::app
