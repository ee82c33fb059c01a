/* Exception vectors. Interrupts (0x500 external, 0x900 decrementer) save what C may change and call board_interrupt(vector); everything else
   is a fault: it is recorded as the processor left it, and board_fault() restarts the board. */
        .section .vectors,"ax",@progbits
        .macro FAULT at
        .org  \at
        mtsprg 0,3
        li    3,\at
        b     fault
        .endm
        .macro INTERRUPT at
        .org  \at
        mtsprg 0,3
        mtsprg 1,4
        li    3,\at
        b     interrupt
        .endm
        .irp  at,0x100,0x200,0x300,0x400
        FAULT \at
        .endr
        INTERRUPT 0x500
        .irp  at,0x600,0x700,0x800
        FAULT \at
        .endr
        INTERRUPT 0x900
        .irp  at,0xA00,0xB00,0xC00,0xD00,0xE00,0xF00,0x1000,0x1100,0x1200,0x1300,0x1400,0x1500,0x1600,0x1700
        FAULT \at
        .endr

        .org  0x1800

/* The rest lies in the code's block: below it nothing is mapped, once translation is on. */
        .section .text,"ax",@progbits
/* On the acquisition's stack: from the top when the background was interrupted, below what is there otherwise. Frame of 256 bytes. */
interrupt:
        mtsprg 2,5
        mfcr  4
        mtsprg 3,4
        lis   5,board_acquisition_stack_begin@ha
        addi  5,5,board_acquisition_stack_begin@l
        subf  4,5,1
        cmplwi 4,0x8000                         /* the stack's size */
        mr    4,1
        ble   1f
        lis   4,board_acquisition_stack_end@ha
        addi  4,4,board_acquisition_stack_end@l
1:      stw   1,-256(4)
        addi  1,4,-256
        stw   0,16(1)
        stw   2,20(1)
        mfsprg 0,0
        stw   0,28(1)                           /* r3 */
        mfsprg 0,1
        stw   0,32(1)                           /* r4 */
        mfsprg 0,2
        stw   0,36(1)                           /* r5 */
        stw   6,40(1)
        stw   7,44(1)
        stw   8,48(1)
        stw   9,52(1)
        stw   10,56(1)
        stw   11,60(1)
        stw   12,64(1)
        mfsprg 0,3
        stw   0,68(1)                           /* CR */
        mflr  0
        stw   0,72(1)
        mfctr 0
        stw   0,76(1)
        mfxer 0
        stw   0,80(1)
        mfsrr0 0
        stw   0,84(1)
        mfsrr1 0
        stw   0,88(1)
        mfmsr 0
        ori   0,0,0x2032                        /* FP, IR, DR, RI */
        mtmsr 0
        isync
        stfd  0,96(1)
        stfd  1,104(1)
        stfd  2,112(1)
        stfd  3,120(1)
        stfd  4,128(1)
        stfd  5,136(1)
        stfd  6,144(1)
        stfd  7,152(1)
        stfd  8,160(1)
        stfd  9,168(1)
        stfd  10,176(1)
        stfd  11,184(1)
        stfd  12,192(1)
        stfd  13,200(1)
        mffs  0
        stfd  0,208(1)
        lis   12,board_interrupt@ha
        addi  12,12,board_interrupt@l
        mtctr 12
        bctrl
        mfmsr 0                                 /* no interrupt, none recoverable, from here on */
        rlwinm 0,0,0,17,15
        rlwinm 0,0,0,31,29
        mtmsr 0
        isync
        lfd   0,208(1)
        mtfsf 255,0
        lfd   0,96(1)
        lfd   1,104(1)
        lfd   2,112(1)
        lfd   3,120(1)
        lfd   4,128(1)
        lfd   5,136(1)
        lfd   6,144(1)
        lfd   7,152(1)
        lfd   8,160(1)
        lfd   9,168(1)
        lfd   10,176(1)
        lfd   11,184(1)
        lfd   12,192(1)
        lfd   13,200(1)
        addi  5,1,92                            /* no reservation outlives an interrupt: this uses up one, on a word that nobody has */
        stwcx. 0,0,5
        lwz   0,84(1)
        mtsrr0 0
        lwz   0,88(1)
        mtsrr1 0
        lwz   0,72(1)
        mtlr  0
        lwz   0,76(1)
        mtctr 0
        lwz   0,80(1)
        mtxer 0
        lwz   0,68(1)
        mtcr  0
        lwz   0,16(1)
        lwz   2,20(1)
        lwz   3,28(1)
        lwz   4,32(1)
        lwz   5,36(1)
        lwz   6,40(1)
        lwz   7,44(1)
        lwz   8,48(1)
        lwz   9,52(1)
        lwz   10,56(1)
        lwz   11,60(1)
        lwz   12,64(1)
        lwz   1,0(1)
        rfi

/* Misses of the 603e's translation come with registers 0 to 3 exchanged (MSR[TGPR]): the vector waits in SPRG1 while they are put back. */
fault:  mtsprg 1,3
        mfmsr 3
        rlwinm 3,3,0,15,13
        mtmsr 3
        isync
        lis   3,board_fault_registers@ha
        addi  3,3,board_fault_registers@l
        stw   1,32(3)
        mfsprg 1,1
        stw   1,0(3)
        mfsrr0 1
        stw   1,4(3)
        mfsrr1 1
        stw   1,8(3)
        mfspr 1,19                              /* DAR */
        stw   1,12(3)
        mfspr 1,18                              /* DSISR */
        stw   1,16(3)
        mflr  1
        stw   1,20(3)
        mfspr 1,976                             /* DMISS */
        stw   1,24(3)
        mfspr 1,980                             /* IMISS */
        stw   1,28(3)
        lis   1,board_fault_stack_end@ha
        addi  1,1,board_fault_stack_end@l
        li    0,0
        stwu  0,-16(1)
        mfmsr 3
        ori   3,3,0x2032
        mtmsr 3
        isync
        lis   12,board_fault@ha
        addi  12,12,board_fault@l
        mtctr 12
        bctr
        .section .note.GNU-stack,"",@progbits
