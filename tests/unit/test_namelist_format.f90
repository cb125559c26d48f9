!> The format of input files: refusals, with a message that names the line and the change needed.
program test_namelist_format
   use ehlwave_errors, only: error_t
   use ehlwave_namelist, only: namelist_t
   use ehlwave_text, only: to_text
   use testing, only: test_t
   implicit none (type, external)

   character(len=1), parameter :: nl = achar(10), cr = achar(13)
   character(len=*), parameter :: path = 'FILE'
   type(test_t) :: test

   call refuse_formats()
   call refuse_names()
   call test%finish()

contains

   subroutine refuse_formats()
      call refuse_text('&g'//nl//' a = 1'//nl, 1, 'group &g is not closed: put ''/''', 'end of file in a group')
      call refuse_text('&g'//nl//' a = 1'//nl//'&h b = 2 /', 3, 'group &g of line 1 is not closed', 'group in a group')
      call refuse_text('&g'//nl//' a = 1'//nl//'&end', 3, 'put ''/'' on a line', 'old end of group')
      call refuse_text(nl//'a = 1'//nl//'&g /', 2, '''a'' stands outside a group', 'text before the groups')
      call refuse_text('&g /'//nl//'b', 2, '''b'' stands outside a group', 'text after the groups')
      call refuse_text('&g /'//nl//'/', 2, '''/'' stands outside a group', 'slash after the groups')
      call refuse_text('&g'//nl//'a = ''x'//nl//'b = ''y'' /', 2, 'close the text with '' on the line', 'open quote')
      call refuse_text('&g a = "x', 1, 'close the text with " on the line', 'open quote at the end of the file')
      call refuse_text('&g a = "x'//cr//nl//'"/', 1, 'quote without', 'open quote before CR LF')
      call refuse_text('&g'//nl//'a ='//nl//'b = 1 /', 2, 'key ''a'' has no value', 'no value before a key')
      call refuse_text('&g'//nl//'a ='//nl//'/', 2, 'key ''a'' has no value', 'no value before the end')
      call refuse_text('&g a = , b = 1 /', 1, 'empty value of key ''a''', 'comma for a value')
      call refuse_text('&g a = 1,,2 /', 1, 'empty value of key ''a''', 'two commas')
      call refuse_text('&g a = 1,'//nl//',2 /', 2, 'empty value of key ''a''', 'two commas on two lines')
      call refuse_text('&g a = 3* /', 1, 'empty value of key ''a'': give a value after ''3*''', 'repeat of nothing')
      call refuse_text('&g a = 3* ''x'' /', 1, 'empty value of key ''a''', 'blank after a repeat count')
      call refuse_text('&g a = 0*1 /', 1, 'repeat count in ''0*1'' of key ''a'' must be from 1', 'repeat 0')
      call refuse_text('&g a = 100001*1 /', 1, 'repeat count in ''100001*1'' of key ''a''', 'large repeat')
      call refuse_text('&g a = 99999999999*1 /', 1, 'repeat count in', 'very large repeat')
      call refuse_text('&g a = 90000*1, 20000*1 /', 1, 'key ''a'': more than 100000 values', 'many values')
      call refuse_text('&g'//nl//'a(2) = 1 /', 2, 'array elements are not accepted: write the whole list', 'element')
      call refuse_text('&g a = 1'//nl//'b (2) = 1 /', 2, '''('' after ''b''', 'element after a blank')
      call refuse_text('&g a = (1, 2) /', 1, '''('' is not accepted', 'complex number')
      call refuse_text('&g a = 1/2 /', 1, 'write fractions as decimal numbers', 'fraction')
      call refuse_text('&g a = /tmp/x /', 1, 'put text that holds ''/'' into quotes', 'path without quotes')
      call refuse_text('&g a = don''t /', 1, 'quote without its partner', 'quote in a word')
      call refuse_text('&g a = don''t, b = ''x'' /', 1, 'key ''a'': ''don'' and what follows are not apart', 'quotes in words')
      call refuse_text('&g a = ''x''''y'' /', 1, '', 'doubled quote is accepted', is_accepted=.true.)
      call refuse_text('&g a = ''x''y'' /', 1, 'key ''a'': ''x'' and what follows are not apart', 'quote not doubled')
      call refuse_text('&g a = ''x''b = 1 /', 1, 'are not apart', 'key attached to a text')
      call refuse_text('&g a'//nl//'/', 1, 'no ''='' after it: write ''key = value''', 'key alone')
      call refuse_text('&g'//nl//' a 1 /', 2, 'no key before ''a'', or no ''=''', 'no equals sign')
      call refuse_text('&g ''a'' = 1 /', 1, 'no key before ''a''', 'key in quotes')
      call refuse_text('&g , a = 1 /', 1, ''','' without a key', 'comma first')
      call refuse_text('&g = 1 /', 1, '''='' without a key', 'equals sign first')
      call refuse_text('&g a == 1 /', 1, '''='' without a key', 'two equals signs')
      call refuse_text('&g a '//char(226)//char(137)//char(136)//' 1 /', 1, 'not plain ASCII', 'UTF-8 outside quotes')
      call refuse_text('&g'//nl//' a ='//char(194)//char(160)//'1 /', 2, 'retype it', 'hard blank')
      call refuse_text(char(255)//char(254)//'&g /', 1, 'not plain ASCII', 'UTF-16')
   end subroutine refuse_formats

   subroutine refuse_names()
      call refuse_text('&g'//nl//'a = 1'//nl//'b = 2'//nl//'A = 3 /', 4, &
                       'key ''a'' is given twice (first on line 2): remove one', 'doubled key')
      call refuse_text('&g a = 1 /'//nl//'&h a = 1 /', 1, '', 'key in two groups is accepted', is_accepted=.true.)
      call refuse_text('&g a = 1 /'//nl//'&h /'//nl//'&G b = 1 /', 3, &
                       'group &g is given twice (first on line 1): put all its keys into one', 'doubled group')
      call refuse_text('& g a = 1 /', 1, '', 'blank before the name of a group is accepted', is_accepted=.true.)
      call refuse_text('& /', 1, '''/'' is not the name of a group', 'group without a name')
      call refuse_text('&', 1, 'not the name of a group', 'group without anything')
      call refuse_text('&2g /', 1, '''2g'' is not the name of a group', 'group that begins with a digit')
      call refuse_text('&g a%b = 1 /', 1, '''a%b'' is not the name of a key: use letters', 'component')
      call refuse_text('&g a-b = 1 /', 1, '''a-b'' is not the name of a key', 'minus in a key')
      call refuse_text('&g 1 = 1 /', 1, '''1'' is not the name of a key', 'number as key')
      call refuse_text('&g a = b = 1 /', 1, 'key ''a'' has no value', 'key as value')
      call refuse_text('&g '//repeat('a', 64)//' = 1 /', 1, 'at most 63', 'long key')
      call refuse_text('&g '//repeat('a', 63)//' = 1 /', 1, '', 'key of 63 letters is accepted', is_accepted=.true.)
   end subroutine refuse_names

   !> The file must be refused with `path:line: ` and `needle`.
   subroutine refuse_text(text, line, needle, what, is_accepted)
      character(len=*), intent(in) :: text, needle, what
      integer, intent(in) :: line
      logical, intent(in), optional :: is_accepted
      type(namelist_t) :: nml
      type(error_t), allocatable :: error

      call nml%load_text(path, text, error)
      if (present(is_accepted)) then
         call test%check_no_error(error, what)
      else
         call test%check_error(error, path//':'//to_text(line)//': ', what//': line')
         call test%check_error(error, needle, what)
      end if
   end subroutine refuse_text

end program test_namelist_format
