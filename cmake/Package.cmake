# The Debian package: `make package`. What is in it is what the install() rules of the tree say.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME muster)
set(CPACK_PACKAGE_CONTACT "Muster contributors <muster@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "formation control for teams of small robots")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"A team of differential-drive robots holds a formation about its leader. When
the leader is lost another one takes over, and the others take the vertices of
the formation by themselves.
.
This is the host's end: a server for robots on Bluetooth, serial or TCP links
beside a motion-capture system, and a simulator that runs the robots' own
firmware.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "avrdude, bluez")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/package)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES cmake/lintian-overrides
    DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME muster)

include(CPack)
