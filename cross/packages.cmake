# What `cmake --install` puts where, and the Debian packages that CPack makes of it:
#   caryatid        the agent, its service, udev rules, user and default programme
#   caryatid-data   the baked characters (any architecture)
#   caryatid-voice  speech through espeak-ng, a program of its own because that is GPL-3+
#   caryatid-tools  caryatid-tool and the characters' recipes, for those who make content
# cross/package.sh builds them: it knows packs, manual pages and dependencies, which are not here.
include(GNUInstallDirs)
set(CARYATID_PACKS "" CACHE PATH "Folder with the baked packs, for caryatid-data")
set(CARYATID_MANUALS "" CACHE PATH "Folder with the manual pages, gzipped")

install(TARGETS caryatid RUNTIME COMPONENT caryatid)
install(FILES ${CMAKE_SOURCE_DIR}/firmware-app/deploy/caryatid.service
  DESTINATION lib/systemd/system COMPONENT caryatid)
install(FILES ${CMAKE_SOURCE_DIR}/firmware-app/deploy/70-caryatid.rules
  DESTINATION lib/udev/rules.d COMPONENT caryatid)
install(FILES ${CMAKE_SOURCE_DIR}/firmware-app/deploy/caryatid.sysusers
  DESTINATION lib/sysusers.d RENAME caryatid.conf COMPONENT caryatid)
install(FILES ${CMAKE_SOURCE_DIR}/firmware-app/deploy/hardware-driver.conf
  DESTINATION share/doc/caryatid/examples COMPONENT caryatid)
# The programme is the deployer's to change; what it was drawn from and its recorded visit are not.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/assets/programme/ DESTINATION /etc/caryatid
  COMPONENT caryatid PATTERN drawings EXCLUDE PATTERN "*.script" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/assets/programme/default.script
  DESTINATION share/doc/caryatid/examples COMPONENT caryatid)
if(CARYATID_PACKS)
  install(FILES ${CARYATID_PACKS}/woman.pack ${CARYATID_PACKS}/man.pack
    DESTINATION share/caryatid COMPONENT caryatid-data)
endif()
set(package_components caryatid caryatid-data)
if(TARGET caryatid-voice)
  install(TARGETS caryatid-voice RUNTIME COMPONENT caryatid-voice)
  list(APPEND package_components caryatid-voice)
endif()
if(TARGET caryatid-tool)
  install(TARGETS caryatid-tool RUNTIME COMPONENT caryatid-tools)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/assets/characters DESTINATION share/caryatid
    COMPONENT caryatid-tools)
  list(APPEND package_components caryatid-tools)
endif()
if(CARYATID_MANUALS)
  install(FILES ${CARYATID_MANUALS}/caryatid.1.gz DESTINATION share/man/man1 COMPONENT caryatid)
  install(FILES ${CARYATID_MANUALS}/caryatid-voice.1.gz DESTINATION share/man/man1
    COMPONENT caryatid-voice)
  install(FILES ${CARYATID_MANUALS}/caryatid-tool.1.gz DESTINATION share/man/man1
    COMPONENT caryatid-tools)
  foreach(package ${package_components})
    install(FILES ${CARYATID_MANUALS}/changelog.gz DESTINATION share/doc/${package}
      COMPONENT ${package})
    install(FILES ${CMAKE_SOURCE_DIR}/cross/debian/copyright DESTINATION share/doc/${package}
      COMPONENT ${package})
  endforeach()
endif()

# Files under /etc are the deployer's: upgrades keep what he changed.
file(GLOB_RECURSE programme_files RELATIVE ${CMAKE_SOURCE_DIR}/assets/programme
  ${CMAKE_SOURCE_DIR}/assets/programme/*)
list(FILTER programme_files EXCLUDE REGEX "^drawings/|[.]script$")
list(TRANSFORM programme_files PREPEND /etc/caryatid/)
list(JOIN programme_files "\n" conffiles)
file(WRITE ${CMAKE_BINARY_DIR}/debian/conffiles "${conffiles}\n")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Caryatid <caryatid@example.org>")
set(CPACK_PACKAGE_VENDOR Caryatid)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${CPACK_PACKAGE_CONTACT})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${package_components})
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${CARYATID_DEBIAN_ARCHITECTURE})
foreach(package ${package_components})
  string(TOUPPER ${package} component)
  set(CPACK_DEBIAN_${component}_PACKAGE_NAME ${package})
endforeach()
# systemd makes the user and runs the service.
set(CPACK_DEBIAN_CARYATID_PACKAGE_DEPENDS "${CARYATID_DEPENDS}, systemd")
set(CPACK_DEBIAN_CARYATID_PACKAGE_RECOMMENDS "caryatid-data, caryatid-voice, libgl1-mesa-dri")
set(CPACK_DEBIAN_CARYATID_PACKAGE_CONTROL_EXTRA
  ${CMAKE_SOURCE_DIR}/cross/debian/postinst ${CMAKE_SOURCE_DIR}/cross/debian/prerm
  ${CMAKE_SOURCE_DIR}/cross/debian/postrm
  ${CMAKE_BINARY_DIR}/debian/conffiles)
set(CPACK_COMPONENT_CARYATID_DESCRIPTION
  "information-kiosk agent: a button is pressed, a person answers
A 3-D person on the screen of a small ARM board, driven by MPEG-4 face and
body animation. Buttons on GPIO lines or USB press, kiosk.toml says what they
do. This package holds the agent and its systemd service, which is not
enabled before the deployer says so.")
set(CPACK_DEBIAN_CARYATID-DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_CARYATID-DATA_PACKAGE_ENHANCES caryatid)
set(CPACK_COMPONENT_CARYATID-DATA_DESCRIPTION
  "characters of the Caryatid information-kiosk agent
A woman and a man: progressive meshes, textures, and tables of MPEG-4 face and
body animation, baked from the MakeHuman base human (CC0).")
set(CPACK_DEBIAN_CARYATID-VOICE_PACKAGE_DEPENDS "${CARYATID_VOICE_DEPENDS}")
set(CPACK_COMPONENT_CARYATID-VOICE_DESCRIPTION
  "voice of the Caryatid information-kiosk agent
Speaks the kiosk's texts through espeak-ng and tells when which sound and word
comes, over a socket. Linked with espeak-ng, so under GPL-3+ as a whole.")
set(CPACK_DEBIAN_CARYATID-TOOLS_PACKAGE_DEPENDS "${CARYATID_TOOL_DEPENDS}")
set(CPACK_COMPONENT_CARYATID-TOOLS_DESCRIPTION
  "content tools of the Caryatid information-kiosk agent
caryatid-tool bakes characters, renders them, simplifies meshes, converts
MPEG-4 face and body animation streams and analyses gait.")
include(CPack)
