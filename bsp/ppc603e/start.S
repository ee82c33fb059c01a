/* From reset, or from the fault handler, to board_main(): address translation by blocks, floating point, data. */
        .section .text.start,"ax",@progbits
        .globl _start
_start: li    3,0x1000                          /* ME; no interrupts, no translation; vectors at 0 */
        mtmsr 3
        isync
        mfspr 3,1008                            /* HID0: the data cache is on after a restart, or as a loader leaves it: */
        andi. 4,3,0x4000
        beq   9f
        li    4,1024                            /* what is only in its 512 lines goes to memory, as other lines come: constants, twice as many */
        mtctr 4
        lis   4,0x0010
8:      lwz   5,0(4)
        addi  4,4,32
        bdnz  8b
        rlwinm 3,3,0,18,16                      /* and it is off before the first store */
        sync
        mtspr 1008,3
        sync
        isync
9:      li    3,0x1000
        ori   3,3,0x2002                        /* FP, RI */
        mtmsr 3
        isync
        bl    map_memory
        lis   1,board_estimation_stack_end@ha
        addi  1,1,board_estimation_stack_end@l
        li    0,0
        stwu  0,-16(1)                          /* the end of the chain of frames */
        li    2,0
        li    13,0
        lis   3,board_data_begin@ha             /* initial values, as the image has them */
        addi  3,3,board_data_begin@l
        lis   4,board_data_end@ha
        addi  4,4,board_data_end@l
        lis   5,board_data_load@ha
        addi  5,5,board_data_load@l
1:      cmplw 3,4
        bge   2f
        lwz   0,0(5)
        stw   0,0(3)
        addi  3,3,4
        addi  5,5,4
        b     1b
2:      lis   3,board_bss_begin@ha
        addi  3,3,board_bss_begin@l
        lis   4,board_bss_end@ha
        addi  4,4,board_bss_end@l
        li    0,0
3:      cmplw 3,4
        bge   4f
        stw   0,0(3)
        addi  3,3,4
        b     3b
4:      lis   3,zero@ha                         /* round to nearest, no traps */
        lfd   0,zero@l(3)
        mtfsf 255,0
        lis   4,0x7FFF
        mtdec 4
        mfspr 3,1008                            /* HID0: both caches on, doze when told to rest */
        oris  3,3,0x0080
        ori   4,3,0xCC00                        /* ... emptied first: nothing in them is newer than memory, but older */
        ori   3,3,0xC000
        sync
        isync
        mtspr 1008,4
        sync
        mtspr 1008,3
        sync
        isync
        lis   3,board_estimation_stack_begin@ha /* paint, by which the most that was used is seen */
        addi  3,3,board_estimation_stack_begin@l
        addi  4,1,-64
        bl    paint
        lis   3,board_acquisition_stack_begin@ha
        addi  3,3,board_acquisition_stack_begin@l
        lis   4,board_acquisition_stack_end@ha
        addi  4,4,board_acquisition_stack_end@l
        bl    paint
        bl    board_main
5:      b     5b

paint:  lis   5,0xA5C3
        ori   5,5,0x965A
6:      cmplw 3,4
        bgelr
        stw   5,0(3)
        addi  3,3,4
        b     6b

/* Blocks: code and constants (read only), data, the mission's memory, input and output. No page tables: all else is a miss, which traps. */
#include "bsp/ppc603e/block.inc"
map_memory:
        li    3,0
        .irp  n,528,530,532,534,536,538,540,542
        mtspr \n,3
        .endr
        .irp  n,0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15
        mtsr  \n,3
        .endr
        isync
        BAT   528,0x0010,0x001E,0x0010,0x0001   /* IBAT0: 0x00100000, 1 MB, supervisor, read only */
        BAT   536,0x0010,0x001E,0x0010,0x0001   /* DBAT0: the same */
        BAT   538,0x0040,0x007E,0x0040,0x0002   /* DBAT1: 0x00400000, 4 MB, read and write */
        BAT   540,0x0800,0x0FFE,0x0800,0x0002   /* DBAT2: 0x08000000, 128 MB, read and write */
        BAT   542,0xFC00,0x07FE,0xFC00,0x002A   /* DBAT3: 0xFC000000, 64 MB, not cached, guarded; map_loaded() changes it for a while */
        isync
        mfmsr 3
        ori   3,3,0x0030                        /* IR, DR */
        mtmsr 3
        isync
        blr

        .section .rodata
        .balign 8
zero:   .long 0,0
        .section .note.GNU-stack,"",@progbits
