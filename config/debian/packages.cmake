# Two packages by CPack: `cpack -G DEB` in a build folder of the preset `package`.
set(CPACK_PACKAGE_NAME sculptd)
set(CPACK_PACKAGE_VENDOR "The sculptd authors")
set(CPACK_PACKAGE_CONTACT "The sculptd authors <sculptd@localhost>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL sculpt sculptd)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_SCULPT_PACKAGE_NAME sculpt)
set(CPACK_COMPONENT_SCULPT_DESCRIPTION "plans carving for robot arms, here or on a sculptd server
Plans, checks and fetches joint trajectories that carve a mesh out of a block
of material. Shell completions, cells and sample meshes are included.")
set(CPACK_DEBIAN_SCULPTD_PACKAGE_NAME sculptd)
set(CPACK_DEBIAN_SCULPTD_PACKAGE_DEPENDS "sculpt (= ${PROJECT_VERSION}-1), procps")  # the unit reloads by `kill`
set(CPACK_DEBIAN_SCULPTD_PACKAGE_RECOMMENDS "init-system-helpers")
set(CPACK_COMPONENT_SCULPTD_DESCRIPTION "plan server for robotic sculpting
A daemon that accepts meshes and robot cells over TCP and streams back joint
trajectories that carve them, free of collisions and checked twice.")
set(CPACK_DEBIAN_SCULPTD_PACKAGE_CONTROL_EXTRA
    ${CMAKE_SOURCE_DIR}/config/debian/conffiles ${CMAKE_SOURCE_DIR}/config/debian/postinst
    ${CMAKE_SOURCE_DIR}/config/debian/prerm ${CMAKE_SOURCE_DIR}/config/debian/postrm)
include(CPack)
