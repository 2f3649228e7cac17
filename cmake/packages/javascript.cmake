# Read when the documentation is installed. Sphinx puts scripts into each site; Debian has those that never differ in
# libjs-sphinxdoc, on which the package depends, and wants a link to them, so that they are mended in one place.
# ORTUNG_SITE: where the site is installed, in PREFIX/share/doc/ortung.
set(shared /usr/share/javascript/sphinxdoc/1.0)
file(GLOB scripts RELATIVE $ENV{DESTDIR}${ORTUNG_SITE}/_static $ENV{DESTDIR}${ORTUNG_SITE}/_static/*.js)
if(ORTUNG_SITE STREQUAL "/usr/share/doc/ortung/html")  # elsewhere a site stands for itself
  foreach(script IN LISTS scripts)
    set(own $ENV{DESTDIR}${ORTUNG_SITE}/_static/${script})
    if(EXISTS ${shared}/${script})
      file(REMOVE ${own})
      file(CREATE_LINK ../../../../javascript/sphinxdoc/1.0/${script} ${own} SYMBOLIC)
    endif()
  endforeach()
endif()
