/* A 603e without an operating system under a program that was made for one: from the loader to the program's entry, and the program's calls
   to the system (calls.cpp). Blocks only, as on the board (bsp/ppc603e/start.S); all else traps, and is told. */
#include "bsp/ppc603e/block.inc"

        .section .text.start,"ax",@progbits
        .globl _start
_start: li    3,0x1000                          /* ME */
        mtmsr 3
        isync
        li    3,0
        .irp  n,528,530,532,534,536,538,540,542
        mtspr \n,3
        .endr
        isync
        BAT   528,0x0010,0x001E,0x0010,0x0002   /* IBAT0, DBAT0: 0x00100000, 1 MB: this */
        BAT   536,0x0010,0x001E,0x0010,0x0002
        BAT   530,0x1000,0x07FE,0x0400,0x0002   /* IBAT1, DBAT1: 0x10000000 at 0x04000000, 64 MB: the program */
        BAT   538,0x1000,0x07FE,0x0400,0x0002
        BAT   540,0x2000,0x0FFE,0x0800,0x0002   /* DBAT2: 0x20000000 at 0x08000000, 128 MB: its heap, stack and arguments */
        BAT   542,0xFC00,0x07FE,0xFC00,0x002A   /* DBAT3: devices, not cached, guarded */
        isync
        mfspr 3,1008                            /* HID0: both caches on, emptied first */
        ori   4,3,0xCC00
        ori   3,3,0xC000
        mtspr 1008,4
        sync
        mtspr 1008,3
        isync
        li    3,0x1000
        ori   3,3,0x2032                        /* FP, IR, DR, RI */
        mtmsr 3
        isync
        lis   3,zero@ha                         /* round to nearest, no traps */
        lfd   0,zero@l(3)
        mtfsf 255,0
        lis   1,kernel_stack_end@ha
        addi  1,1,kernel_stack_end@l
        li    0,0
        stwu  0,-16(1)
        bl    prepare_program                   /* its stack, and behind it its entry */
        mtctr 4
        mr    1,3
        li    0,0
        li    2,0
        li    13,0
        mtlr  0
        .irp  n,3,4,5,6,7,8,9,10
        li    \n,0
        .endr
        bctr

        .section .vectors,"ax",@progbits
        .macro FAULT at
        .org  \at
        li    5,\at
        b     fault
        .endm
        .irp  at,0x100,0x200,0x300,0x400,0x500,0x600,0x700,0x800,0x900,0xA00,0xB00
        FAULT \at
        .endr
        .org  0xC00
        mr    9,0                               /* number, behind six arguments */
        mr    10,1
        lis   1,kernel_stack_end@ha
        addi  1,1,kernel_stack_end@l-64
        stw   10,32(1)
        mflr  0
        stw   0,36(1)
        mfcr  0
        stw   0,40(1)
        mfsrr0 0
        stw   0,44(1)
        mfsrr1 0
        stw   0,48(1)
        li    0,0
        stw   0,0(1)
        b     call
        .irp  at,0xD00,0xE00,0xF00,0x1000,0x1100,0x1200,0x1300,0x1400,0x1500,0x1600,0x1700
        FAULT \at
        .endr
        .org  0x1800

        .section .text,"ax",@progbits
call:   mfmsr 0
        ori   0,0,0x0032
        mtmsr 0
        isync
        bl    serve_call
        lwz   4,40(1)                           /* an error is told by the summary overflow of CR0 */
        rlwinm 4,4,0,4,2
        cmpwi 3,0
        bge   1f
        neg   3,3
        oris  4,4,0x1000
1:      mfmsr 0
        rlwinm 0,0,0,31,29                      /* not recoverable from here on */
        mtmsr 0
        isync
        mtcr  4
        lwz   0,36(1)
        mtlr  0
        lwz   0,44(1)
        mtsrr0 0
        lwz   0,48(1)
        mtsrr1 0
        lwz   1,32(1)
        rfi

/* Misses come with registers 0 to 3 exchanged (MSR[TGPR]). */
fault:  mfmsr 4
        rlwinm 4,4,0,15,13
        mtmsr 4
        isync
        lis   1,kernel_stack_end@ha
        addi  1,1,kernel_stack_end@l-64
        mr    3,5
        mfsrr0 4
        mfspr 5,19                              /* DAR */
        mfspr 6,976                             /* DMISS */
        mfmsr 7
        ori   7,7,0x0032
        mtmsr 7
        isync
        b     tell_fault

        .section .rodata
        .balign 8
zero:   .long 0,0
        .section .note.GNU-stack,"",@progbits
