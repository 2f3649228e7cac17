int aLibraryWithoutPlugins();
int aLibraryWithoutPlugins() { return 0; }
