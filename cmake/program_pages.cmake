# SPDX-License-Identifier: MIT
# Makes files from the output of the programs (--help man, and so on): manual pages, completions,
# and a reference page for the documentation site, ${PROJECT_BINARY_DIR}/pages/options-PROGRAM.md.
#
# The programs print their pages and therefore must run on this machine. If they cannot,
# PH_HOST_PROGRAMS names a folder with programs of the same version that can;
# CMAKE_CROSSCOMPILING_EMULATOR is used if it is set.
include(GNUInstallDirs)
set(PH_HOST_PROGRAMS "" CACHE PATH
    "When cross-building: a folder with the programs that run here, to print their pages")
# The folder of zsh completions depends on the distribution: Debian has a separate one for packages.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr" AND EXISTS /etc/debian_version)
  set(zsh_folder ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
else()
  set(zsh_folder ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
endif()
set(PH_INSTALL_ZSHDIR ${zsh_folder} CACHE PATH "Folder of completions for zsh, below the prefix")
mark_as_advanced(PH_HOST_PROGRAMS PH_INSTALL_ZSHDIR)

# ph_program_pages(PROGRAM): builds and installs the manual page, Markdown page and completions of a
# program.
function(ph_program_pages program)
  set(printer ${program})
  if(PH_HOST_PROGRAMS)
    set(printer ${PH_HOST_PROGRAMS}/${program})
  elseif(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    message(STATUS "${program}: no manual page and no completions: it does not run here, and "
                   "PH_HOST_PROGRAMS names none that does")
    return()
  endif()
  set(folder ${PROJECT_BINARY_DIR}/pages)
  file(MAKE_DIRECTORY ${folder})
  set(pages "")
  # Each file has the name under which the shell looks for it.
  foreach(page man=${program}.1 markdown=options-${program}.md bash=${program} zsh=_${program}
               fish=${program}.fish)
    string(REGEX MATCH "^([a-z]+)=(.*)$" page ${page})
    set(${CMAKE_MATCH_1} ${folder}/${CMAKE_MATCH_2})
    list(APPEND pages ${folder}/${CMAKE_MATCH_2})
    add_custom_command(OUTPUT ${folder}/${CMAKE_MATCH_2}
                       COMMAND ${printer} --help ${CMAKE_MATCH_1} > ${folder}/${CMAKE_MATCH_2}
                       DEPENDS ${printer} VERBATIM)
  endforeach()
  add_custom_target(${program}-pages ALL DEPENDS ${pages})
  if(PH_INSTALL)
    install(FILES ${man} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
    install(FILES ${bash} COMPONENT programs
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${zsh} DESTINATION ${PH_INSTALL_ZSHDIR} COMPONENT programs)
    install(FILES ${fish} DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
            COMPONENT programs)
  endif()
endfunction()
