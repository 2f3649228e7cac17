# Read when the documentation is installed. Sphinx puts scripts into each site; Debian has those that never differ in
# libjs-sphinxdoc and node-normalize.css, on which the package depends, and wants links to them, so that they are mended in one
# place. ORTUNG_SITE: where the site is installed, in PREFIX/share/doc/ortung.
if(ORTUNG_SITE STREQUAL "/usr/share/doc/ortung/html")  # elsewhere a site stands for itself
  set(static $ENV{DESTDIR}${ORTUNG_SITE}/_static)
  file(GLOB scripts RELATIVE ${static} ${static}/*.js)
  foreach(script IN LISTS scripts)
    if(EXISTS /usr/share/javascript/sphinxdoc/1.0/${script})
      file(REMOVE ${static}/${script})
      file(CREATE_LINK ../../../../javascript/sphinxdoc/1.0/${script} ${static}/${script} SYMBOLIC)
    endif()
  endforeach()
  file(REMOVE ${static}/styles/normalize.css)
  file(CREATE_LINK ../../../../../javascript/normalize.css/normalize.css ${static}/styles/normalize.css SYMBOLIC)
endif()
