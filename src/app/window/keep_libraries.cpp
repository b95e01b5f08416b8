// Only in builds with the address sanitizer. SDL and OpenGL load drivers and unload them at the
// end, before leaks are looked for; a leak in one of them could then not be told from one of ours.
// So libraries stay loaded, and the report names them.
extern "C" int dlclose(void*) noexcept { return 0; }
