# Headers of what a program cannot have from markervp::compat: each ends the compilation, and says what to do.

# refuse(SENTENCE HEADER…)
function(_refuse SENTENCE)
  foreach(header IN LISTS ARGN)
    file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/refused/${header}" @ONLY CONTENT "#error \"${header}: ${SENTENCE}\"\n")
  endforeach()
endfunction()

set(copy "The device is modelled, but its driver is not part of markervp::compat. Name your copy of the vendor's drivers: \
markervp_add_program(… VENDOR_BSP <libsrc of the board support package>)")
foreach(driver axicdma iic intc llfifo qspips spi sysmon uartlite vtc wdtps)
  _refuse("${copy}" x${driver}.h)
endforeach()
_refuse("${copy}" xdevcfg.h xaxicdma_hw.h xiic_l.h xintc_l.h xllfifo_hw.h xqspips_hw.h xspi_l.h xsysmon_hw.h xuartlite_l.h
  xvtc_hw.h xwdtps_hw.h xdevcfg_hw.h)
_refuse("There is no card in the platform's SDIO controllers. Leave the files out, or read them with fopen() from your \
computer in this build" ff.h diskio.h xsdps.h)
_refuse("There is no network at the platform's Ethernet controllers, and no lwIP in this board support package. Leave the \
connection out in this build, or put what arrives by it into memory" xemacps.h lwip/init.h lwip/ip.h lwip/ip_addr.h lwip/err.h
  lwip/opt.h lwip/sys.h lwip/mem.h lwip/pbuf.h lwip/tcp.h lwip/tcp_impl.h lwip/priv/tcp_priv.h lwip/udp.h lwip/dhcp.h lwip/inet.h
  lwip/netif.h lwip/sockets.h lwip/timers.h lwip/tcpip.h lwipopts.h netif/xadapter.h netif/xemacpsif.h netif/xtopology.h)
_refuse("There is no transceiver at the platform's USB controllers. Leave USB out in this build" xusbps.h xusbps_hw.h xusbps_endpoint.h)
_refuse("The device is not modelled: an access would end the program. Leave it out in this build" xcanps.h xwdttb.h
  xvprocss.h xv_tpg.h xi2s.h xaxiethernet.h xemaclite.h xcsi.h xcsiss.h xcsi2tx.h xcsi2txss.h xdphy.h xl2cc.h
  xl2cc_counter.h xpm_counter.h)
_refuse("The clock wizard is modelled, but its driver is not part of markervp::compat. Write its registers (PG065) with Xil_Out32()"
  xclk_wiz.h xclk_wiz_hw.h)
_refuse("CMSIS-DSP is a library of ARM's and no part of a board support package. Name its sources and folder in this build: \
target_sources() and target_include_directories() behind markervp_add_program()" arm_math.h arm_const_structs.h)
_refuse("The Zynq-7000 has no such device: this program is for a Zynq UltraScale+" xipipsu.h xsecure.h xsecure_aes.h xsecure_sha.h
  xdpdma.h xdppsu.h xavbuf.h xzdma.h xcsudma.h xsysmonpsu.h xresetps.h xqspipsu.h xrtcpsu.h pm_api_sys.h pm_defs.h)
_refuse("OpenAMP loads a second program, and such a loader has nothing to load here: name the other program's sources behind CORE1 in markervp_add_program(), or start core 1 at a function of this one" openamp/open_amp.h
  openamp/hil.h metal/sys.h metal/irq.h metal/io.h)
_refuse("Name your copy of the kernel: markervp_add_program(… FREERTOS <FreeRTOS-Kernel>)" FreeRTOS.h)
