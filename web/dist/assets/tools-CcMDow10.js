import{C as e,S as t,a as n,b as r,d as i,i as a,o,p as s,r as c,u as l,w as u,x as d}from"./index-Qc_W3yad.js";import{r as f}from"./value-BA77vwhC.js";import{t as p}from"./axis-picker-BWtEly2K.js";import{t as m}from"./tab-lKZc--Iv.js";import{n as h,r as g,t as _}from"./hold-uLSkGs3s.js";function v(e,t){return e.find(({to_pps:e})=>t<=e)??e.at(-1)??null}function y(e,t,n){let r=Math.floor(Math.max(n-t,0)*1e3/e.delta);return[e.least_ms,Math.max(r,e.least_ms)]}function ee(e,t,n){let r=e.pulsesPerCount??1,i=[],a=Math.abs(t)*r,o=e.highPps*r,s=n.find(({number:t})=>t===e.window)??v(n,o),c=s?.step_pps??1,l=e=>Math.max(e-e%c,c),u=l(Math.min(o,s?.to_pps??o)),d=Math.min(l(Math.max(e.lowPps*r,s?.least_low_pps??0)),u),f=(e,t)=>{if(s===null)return e;let[n,r]=y(s,d,u),a=Math.min(Math.max(e,n),r);return a!==e&&i.push(`${t} of ${e} ms becomes ${a} ms at these speeds.`),a},p=f(e.accelerationMs,`Acceleration`),m=f(e.decelerationMs,`Deceleration`),h=1e3*a/2,g=(d+u)/2;m!==p&&Math.max(p,m)*g>h&&(i.push(`A ramp needs more than half of the way: the deceleration is that of the acceleration.`),m=p);let _=e=>(u-d)*1e3/e;return{accelerationMs:p,decelerationMs:m,window:s,notes:i,move:{pulses:a,startPps:d,stopPps:d,topPps:u,acceleration:_(p),deceleration:_(m),sCurve:e.sCurve}}}var b=16e6,x=2047;function S(e){return b/(2**e*2048*32)}function C({pulse:e,ramp:t}){return b**2/2**(t+e+29)}function te({pulse:e,ramp:t}){let n=Math.max(2**(t-e-1),1);return[Math.min(Math.ceil(n),x),Math.min(Math.max(2**(t-e+12)-1,1),x)]}function ne(e,t){let n=w(t=>S(t)*x>=e);return{pulse:n,ramp:w(e=>C({pulse:n,ramp:e})*x>=t)}}function w(e){let t=13;for(;t>0&&!e(t);)--t;return t}var re=1024;function ie(e,t){return Math.round(t*e*512/re/16)*16}function ae(e,t,n){return Math.round(t*e*256/n)}var T={topSpeed:4,acceleration:5,stopSpeed:130,mode:138,microsteps:140,ramp:153,pulse:154},oe=1,se=[`high_speed`,`low_speed`,`acceleration`,`deceleration`,`own_deceleration`,`s_curve`,`speed_window`,`closed_loop`,`closed_loop_ratio`];function ce(e,t){return e.language===`tmcl`?E(e,Object.values(T).map(e=>`AP${e}.${t}`)):e.parameters.filter(e=>se.includes(e.role)&&(e.axis===t||e.axis===null))}function le(e,t,n,r){let i=e.parameters.filter(({role:e})=>e===r),a=e=>i.find(t=>t.axis===e)?.id??``;return O(n,a(t))||O(n,a(null))}function E(e,t){let n=new Map(e.parameters.map(e=>[e.id,e]));return t.map(e=>n.get(e)).filter(e=>e!==void 0)}function ue(e,t,n){if(e.language===`tmcl`)return{divisors:D(t,n)};let r=le(e,t,n,`closed_loop_ratio`);return r>0?{pulsesPerCount:r}:{}}function de(e,t,n){let r=n[`AP${T.microsteps}.${t}`];return e.language===`tmcl`&&typeof r==`number`?2**r:null}function fe(e,t,n,r){return e.language===`tmcl`?pe(t,n,r):me(e,t,n,r)}function pe(e,t,n){let r=n=>O(t,`AP${T[n]}.${e}`),i=D(e,t),a=S(i.pulse),o=r(`acceleration`)*C(i),s=[],[c,l]=te(i);return(r(`acceleration`)<c||r(`acceleration`)>l)&&s.push(`With these divisors positioning ramps have accelerations from ${c} to ${l}.`),r(`mode`)===oe&&s.push(`The soft approach to the target (ramp mode 1) takes longer than shown.`),{notes:s,move:{pulses:n,startPps:a,stopPps:r(`stopSpeed`)*a,topPps:r(`topSpeed`)*a,acceleration:o,deceleration:o,sCurve:!1}}}function me(e,t,n,r){let i=r=>le(e,t,n,r),a=i(`acceleration`),o=!e.parameters.some(({role:e})=>e===`own_deceleration`)||i(`own_deceleration`)!==0,s=ee({highPps:i(`high_speed`),lowPps:i(`low_speed`),accelerationMs:a,decelerationMs:o?i(`deceleration`):a,sCurve:i(`s_curve`)!==0,window:i(`speed_window`),pulsesPerCount:i(`closed_loop`)===0?null:i(`closed_loop_ratio`)||1},r,e.speed_windows);return{move:s.move,notes:s.notes}}function D(e,t){return{pulse:O(t,`AP${T.pulse}.${e}`),ramp:O(t,`AP${T.ramp}.${e}`)}}function O(e,t){let n=e[t];return typeof n==`number`?n:0}var k=u`
  :host {
    max-width: 1180px;
  }
  .panel {
    margin-bottom: var(--gap);
  }
  .fields {
    display: grid;
    grid-template-columns: repeat(auto-fill, minmax(148px, 1fr));
    gap: 8px 12px;
  }
  .row > select,
  .row > label select {
    width: auto;
    max-width: 100%;
  }
  .text {
    max-width: 76ch;
    color: var(--muted);
  }
  .large {
    font-size: 20px;
    font-weight: 650;
    font-variant-numeric: tabular-nums;
  }
  dl {
    display: grid;
    grid-template-columns: repeat(auto-fill, minmax(150px, 1fr));
    gap: 8px 14px;
    margin: 0;
  }
  dt {
    color: var(--muted);
    font-size: 12px;
  }
  dd {
    margin: 0;
    font-weight: 600;
    font-variant-numeric: tabular-nums;
  }
`,A=class extends m{static properties={...m.properties,axis:{state:!0},values:{state:!0}};read={};#e=``;constructor(){super(),this.axis=``,this.values={}}needs(){return[]}willUpdate(e){super.willUpdate(e),this.axis===``&&(this.axis=this.catalog.axes[0]??``),this.active&&this.reachable&&this.#e!==this.axis&&(this.#e=this.axis,this.refresh()),this.active||(this.#e=``)}async refresh(){let e=this.needs().filter(({readable:e})=>e);await l(async()=>{let t=e.map(async({id:e})=>[e,await this.api.parameter(this.device.name,e)]),n=Object.fromEntries(await Promise.all(t));this.read=n,this.values={...n}})}async write(e,t){let n=await l(()=>this.api.setParameter(this.device.name,e,t));return n&&(this.read={...this.read,[e]:t}),this.values={...this.values,[e]:n?t:this.read[e]??t},n}get tried(){return this.needs().filter(({id:e,writable:t})=>t&&this.values[e]!==this.read[e])}async writeTried(){for(let{id:e}of this.tried){let t=this.values[e];if(t!==void 0&&!await this.write(e,t))return}}picker(){return p(this.catalog.axes,this.axis,`${this.localName}-axis`,e=>this.axis=e)}trial(e){let n=this.values[e.id],r=[e.text,f(e)].filter(Boolean).join(` `);return t`
      <label title=${r}>
        ${e.name} ${e.unit?`[${e.unit}]`:``}
        <input
          inputmode="decimal"
          autocomplete="off"
          .value=${n===void 0?``:String(n)}
          ?readonly=${!e.writable}
          @change=${t=>this.#t(e,t.target)}
        />
        <span><code>${e.id}</code> ${n===this.read[e.id]?d:t`<span class="badge busy">tried</span>`}</span>
      </label>
    `}#t(e,t){let r=n(t.value),{low:i,high:a}=e;r!==null&&(i===null||r>=i)&&(a===null||r<=a)?this.values={...this.values,[e.id]:r}:t.value=String(this.values[e.id]??``)}};function he(e){return e.fullSteps*e.microsteps}function j(e,t,n){let r=he(t),i={position:``,speed:`/s`,acceleration:`/s²`}[e],a=[],o=(e,t,n,r,i)=>{Number.isFinite(r)&&r>0&&a.push({id:e,label:t,name:n,pulses:r,...i&&{range:i}})},{divisors:s,pulsesPerCount:c}=n;return s!==void 0&&e===`speed`&&o(`int`,`int`,`Internal speed`,S(s.pulse),[-x,x]),s!==void 0&&e===`acceleration`&&o(`int`,`int`,`Internal acceleration`,C(s),[0,x]),o(`pulses`,{position:`pulses`,speed:`pps`,acceleration:`pps²`}[e],`Pulses`,1),c!==void 0&&o(`counts`,`counts${i}`,`Encoder counts`,c),o(`full`,`full steps${i}`,`Full steps`,t.microsteps),o(`turns`,`turns${i}`,`Turns of the motor`,r),e===`position`&&o(`degrees`,`°`,`Degrees`,r/360),e===`speed`&&o(`rpm`,`rpm`,`Turns a minute`,r/60),e===`acceleration`&&o(`rpm`,`rpm/s`,`Turns a minute, each second`,r/60),o(`mm`,`mm${i}`,`Millimetres of the load`,r/t.mmPerTurn),a}function ge(e,t,n){let r=e*t.pulses;return n.map(e=>{let t=r/e.pulses;if(e.range===void 0)return{unit:e,exact:t,shown:t,fits:Number.isFinite(t)};let[n,i]=e.range,a=Math.round(t);return{unit:e,exact:t,shown:Math.min(Math.max(a,n),i),fits:a>=n&&a<=i}})}function M(e){if(!Number.isFinite(e))return`–`;let t=Number(e.toPrecision(7)),n=Math.abs(t);return n!==0&&(n>=0xe8d4a51000||n<1e-6)?t.toExponential():t.toString()}var _e=[`position`,`speed`,`acceleration`],ve=class extends A{static properties={...A.properties,drive:{state:!0},divisors:{state:!0},ratio:{state:!0},entries:{state:!0},ramp:{state:!0},counts:{state:!0}};static styles=[s,k,u`
      .quantities {
        display: grid;
        grid-template-columns: repeat(auto-fit, minmax(250px, 1fr));
        gap: var(--gap);
      }
      td:first-child {
        width: 60%;
      }
      td input {
        width: 100%;
        text-align: right;
      }
      td {
        vertical-align: middle;
      }
      h2 {
        margin-bottom: 6px;
      }
      .off input {
        border-color: var(--error);
      }
    `];constructor(){super(),this.drive={fullSteps:200,microsteps:256,mmPerTurn:5},this.divisors={pulse:2,ramp:3},this.ratio=1,this.entries={position:{unit:`turns`,value:1},speed:{unit:`rpm`,value:60},acceleration:{unit:`turns`,value:10}},this.ramp={low:100,high:1e3,ms:300},this.counts=4e3}get#e(){return this.catalog.language===`tmcl`}needs(){return ce(this.catalog,this.axis)}willUpdate(e){super.willUpdate(e),e.has(`device`)&&this.device&&(this.drive=ye(this.device.name,this.#e)),e.has(`values`)&&this.#t()}#t(){let e=de(this.catalog,this.axis,this.values);e!==null&&(this.drive={...this.drive,microsteps:e});let{divisors:t,pulsesPerCount:n}=ue(this.catalog,this.axis,this.values);t&&Object.keys(this.values).length>0&&(this.divisors=t),n&&(this.ratio=n);let[r,i,a]=[`LSPD`,`HSPD`,`ACC`].map(e=>Number(this.values[e+this.axis])||Number(this.values[e]));r&&i&&a&&(this.ramp={low:r,high:i,ms:a})}get#n(){return this.#e?{divisors:this.divisors}:{pulsesPerCount:this.ratio}}#r(e){this.drive={...this.drive,...e},localStorage.setItem(N(this.device.name),JSON.stringify(this.drive))}#i(e){let{unit:t,value:n}=this.entries[e];return n*(j(e,this.drive,this.#n).find(({id:e})=>e===t)?.pulses??1)}render(){return t`
      <section class="panel stack" aria-label="Drive">
        <div class="row">
          <h2 class="grow">Drive</h2>
          ${this.picker()}
          <button class="small" ?disabled=${!this.reachable} @click=${()=>this.refresh()}>Take from the controller</button>
        </div>
        <div class="fields">
          ${this.#a(`Full steps a turn`,this.drive.fullSteps,1,1e5,e=>this.#r({fullSteps:e}))}
          ${this.#a(this.#e?`Microsteps (AP 140)`:`Microsteps of the drive`,this.drive.microsteps,1,4096,e=>this.#r({microsteps:e}))}
          ${this.#a(`Millimetres a turn`,this.drive.mmPerTurn,0,1e6,e=>this.#r({mmPerTurn:e}))}
          ${this.#e?t`
                ${this.#a(`Pulse divisor (AP 154)`,this.divisors.pulse,0,13,e=>{this.divisors={...this.divisors,pulse:Math.round(e)}})}
                ${this.#a(`Ramp divisor (AP 153)`,this.divisors.ramp,0,13,e=>{this.divisors={...this.divisors,ramp:Math.round(e)}})}
              `:this.#a(`Pulses a count (SLR)`,this.ratio,.001,999.999,e=>this.ratio=e)}
        </div>
      </section>
      <div class="quantities">${_e.map(e=>this.#o(e))}</div>
      ${this.#e?this.#c():this.#u()}
    `}#a(e,r,a,o,s){return t`
      <label>
        ${e}
        <input
          inputmode="decimal"
          autocomplete="off"
          .value=${String(r)}
          @change=${t=>{let c=t.target,l=n(c.value);l!==null&&l>=a&&l<=o?s(l):(i(`${e}: ${a} to ${o}.`,`error`),c.value=String(r))}}
        />
      </label>
    `}#o(e){let n=j(e,this.drive,this.#n),{unit:r,value:i}=this.entries[e],a=n.find(({id:e})=>e===r)??n[0];return a?t`
      <section class="panel" aria-label=${e}>
        <h2>${e[0]?.toUpperCase()}${e.slice(1)}</h2>
        <table aria-label="The same ${e} in each unit">
          <tbody>
            ${ge(i,a,n).map(({unit:n,shown:r,exact:o,fits:s})=>{let c=n===a&&Number.isFinite(o)?String(i):M(r);return t`
                <tr class=${s?``:`off`}>
                  <td>
                    <input
                      aria-label="${n.name}, ${n.label}"
                      aria-invalid=${s?`false`:`true`}
                      inputmode="decimal"
                      autocomplete="off"
                      .value=${c}
                      @input=${t=>this.#s(e,n,t.target)}
                    />
                  </td>
                  <td>
                    ${n.label}
                    ${s?d:t`<div class="error-text">${M(o)} is out of range</div>`}
                  </td>
                </tr>
              `})}
          </tbody>
        </table>
      </section>
    `:d}#s(e,t,r){let i=n(r.value);r.setAttribute(`aria-invalid`,String(i===null)),i!==null&&(this.entries={...this.entries,[e]:{unit:t.id,value:i}})}#c(){let e=ne(Math.abs(this.#i(`speed`)),Math.abs(this.#i(`acceleration`))),{microsteps:n,fullSteps:r}=this.drive,i=e.pulse===this.divisors.pulse&&e.ramp===this.divisors.ramp;return t`
      <section class="panel stack" aria-label="Divisors and prescalers">
        <h2>Divisors and prescalers</h2>
        <p class="text">
          Taking this speed and this acceleration as the highest that are needed, these divisors leave the most of the
          registers (firmware manual, 6.1.3).
        </p>
        <div class="row">
          <span>Pulse divisor <strong>${e.pulse}</strong>, ramp divisor <strong>${e.ramp}</strong></span>
          <button class="small" ?disabled=${i} @click=${()=>this.divisors=e}>Calculate with them</button>
          <button class="small" ?disabled=${!this.usable} @click=${()=>this.#l(e)}>Write to the controller</button>
        </div>
        <div class="row end">
          <span>SensOstep prescaler (AP 210) <strong>${ie(n,r)}</strong></span>
          ${this.#a(`Counts a turn, external encoder`,this.counts,1,1e7,e=>this.counts=e)}
          <span>External prescaler (AP 217) <strong>${ae(n,r,this.counts)}</strong></span>
        </div>
      </section>
    `}async#l({pulse:e,ramp:t}){await this.write(`AP154.${this.axis}`,e)&&await this.write(`AP153.${this.axis}`,t)&&i(`Divisors written; speeds and accelerations in internal units mean other speeds now.`)}#u(){let{low:e,high:n,ms:r}=this.ramp,i=e=>this.ramp={...this.ramp,...e},o=v(this.catalog.speed_windows,n),[s,c]=o?y(o,e,n):[0,0],l=(n-e)*1e3/r;return t`
      <section class="panel stack" aria-label="Ramp">
        <h2>Ramp</h2>
        <div class="fields">
          ${this.#a(`Low speed [pps]`,e,1,1e7,e=>i({low:e}))}
          ${this.#a(`High speed [pps]`,n,1,1e7,e=>i({high:e}))}
          ${this.#a(`Time [ms]`,r,1,1e9,e=>i({ms:e}))}
          ${this.#a(`Acceleration [pps²]`,Number(l.toPrecision(6)),1e-6,0xe8d4a51000,t=>i({ms:Math.max(Math.round((n-e)*1e3/t),1)}))}
        </div>
        ${o?t`<p class="text">
              Speed window ${o.number} (SSPDM), ${o.from_pps} to ${o.to_pps} pps: ramps take ${s} to
              ${c} ms between these speeds, over ${a((e+n)/2*r/1e3,0)} pulses with
              ${r} ms.
            </p>`:d}
      </section>
    `}};customElements.define(`pt-calculator`,ve);var N=e=>`drive ${e}`;function ye(e,t){let n={fullSteps:200,microsteps:t?256:10,mmPerTurn:5};try{let t=JSON.parse(localStorage.getItem(N(e))??`{}`),r=e=>typeof t[e]==`number`?t[e]:n[e];return{fullSteps:r(`fullSteps`),microsteps:r(`microsteps`),mmPerTurn:r(`mmPerTurn`)}}catch{return n}}var be=80,xe=3,Se=12e4;async function P(e,t,n,r){let i=performance.now()+Se,a=0,o;for(;;){let s=(await e.status(t)).axes[n];if(s===void 0)throw Error(`There is no axis ${n}.`);if(a=s.speed===0&&s.position===o?.position&&s.encoder===o.encoder?a+1:0,a>=xe||r())return s;if(performance.now()>i)throw Error(`Axis ${n} does not come to rest.`);o=s,await new Promise(e=>window.setTimeout(e,be))}}var F=[[`negative_limit`,`Negative limit`],[`home`,`Home`],[`positive_limit`,`Positive limit`],[`index`,`Index`]],Ce=class extends A{static properties={...A.properties,mode:{state:!0},direction:{state:!0},running:{state:!0},result:{state:!0}};watches=[`status`];#e=new Map;#t=!1;#n=null;static styles=[s,k,h,u`
      button.primary {
        white-space: normal;
      }
      h2 span {
        display: inline-grid;
        place-items: center;
        width: 22px;
        height: 22px;
        margin-right: 6px;
        border-radius: 50%;
        background: var(--busy-bg);
        color: var(--busy);
      }
      .modes {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(260px, 1fr));
        gap: 6px;
      }
      .mode {
        display: grid;
        grid-template-columns: auto 1fr;
        gap: 2px 8px;
        padding: 8px 10px;
        border: 1px solid var(--line);
        border-radius: var(--radius);
        color: var(--text);
        font-size: 13px;
        cursor: pointer;
      }
      .mode:has(:checked) {
        border-color: var(--accent);
        background: var(--busy-bg);
      }
      .mode small {
        grid-column: 2;
        color: var(--muted);
      }
      ul {
        margin: 0;
        padding: 0;
        list-style: none;
      }
      li {
        display: flex;
        gap: 8px;
        align-items: center;
        min-height: 28px;
      }
      pt-hold {
        width: 90px;
      }
    `];constructor(){super(),this.mode=-1,this.direction=-1,this.running=!1,this.result=null}disconnectedCallback(){super.disconnectedCallback(),this.#t=!0}needs(){let{axis:e}=this;if(this.catalog.language===`tmcl`)return E(this.catalog,[194,195,149,12,13].map(t=>`AP${t}.${e}`));let t=[`HSPD`,`LSPD`,`ACC`,`HCA`,`LCA`].flatMap(t=>[t+e,t]);return E(this.catalog,[...t,`RZ`,`ZCNT${e}`,`ZCNT`])}get#r(){return this.live.status?.axes[this.axis]}get#i(){return this.catalog.homing.find(({id:e})=>e===this.mode)??this.catalog.homing[0]}#a(e){for(let[t]of F){let n=e?.[t];n!=null&&this.#e.set(t,(this.#e.get(t)??new Set).add(n))}}#o(e){this.#n=new g(this.api,this.live,this.axis),this.#n.begin(e)}async#s(e,t){let{axis:n,device:r}=this;this.running=!0,this.#t=!1,this.result=null,await l(async()=>{await this.api.act(r.name,{do:`home`,axis:n,mode:e.id,direction:t});let i=await P(this.api,r.name,n,()=>this.#t),a=i.error===null&&!this.#t,o=a?`The axis rests at ${c(i.position)} ${this.catalog.units.position}.`:i.error??`Stopped before the end.`;this.result={ok:a,text:o}})||(this.result={ok:!1,text:`Homing was not done.`}),this.running=!1}async#c(){this.#t=!0,await l(()=>this.api.stop(this.device.name))}render(){let e=this.#r;this.#a(e);let n=this.#i;if(!n)return t`<p class="muted">This controller has no homing.</p>`;let r=n.directions.map(e=>e===`+`?1:-1),i=r.includes(this.direction)?this.direction:r[0]??-1;return t`
      ${this.#u(e)} ${this.#d(e)} ${this.#f(n,r,i)}
      ${this.#m(e)} ${this.#h(e,n,i)}
    `}#l(e,n){return t`<h2 class="grow"><span>${e}</span>${n}</h2>`}#u(e){return t`
      <section class="panel stack" aria-label="Switches">
        <div class="row">${this.#l(1,`Do the switches work?`)} ${this.picker()}</div>
        <p class="text">Press each switch by hand, or in the tab I/O, and see its lamp go on and off.</p>
        <ul>
          ${F.filter(([t])=>e?.[t]!==null&&e?.[t]!==void 0).map(([n,r])=>{let i=this.#e.get(n)?.size===2;return t`
              <li>
                ${_(r,e?.[n],r)}
                <span class="badge ${i?`ok`:``}">${i?`works`:`not seen to change`}</span>
              </li>
            `})}
        </ul>
      </section>
    `}#d(e){let n=(e,n,r)=>t`
      <pt-hold
        label=${n}
        .disabled=${!this.usable||this.running}
        @begin=${()=>this.#o(e)}
        @end=${()=>this.#n?.end()}
        >${r}</pt-hold
      >
    `;return t`
      <section class="panel stack" aria-label="Direction">
        ${this.#l(2,`Does it turn the right way?`)}
        <p class="text">Hold a button for a moment: plus must move the load towards the positive limit.</p>
        <div class="row">
          ${n(-1,`Jog in negative direction`,`◀ −`)} ${n(1,`Jog in positive direction`,`+ ▶`)}
          <span>Position <strong>${c(e?.position)}</strong></span>
          ${e?.encoder===null||e===void 0?d:t`<span>Encoder <strong>${c(e.encoder)}</strong></span>`}
        </div>
      </section>
    `}#f(e,n,r){let{tried:i}=this;return t`
      <section class="panel stack" aria-label="Way of homing">
        ${this.#l(3,`How?`)}
        <div class="modes" role="radiogroup" aria-label="Way of homing">
          ${this.catalog.homing.map(n=>t`
              <label class="mode">
                <input type="radio" name="mode" .checked=${n.id===e.id} @change=${()=>this.mode=n.id} />
                <strong>${n.id} ${n.name}</strong>
                <small>${n.text} <span class="muted">(${n.section})</span></small>
              </label>
            `)}
        </div>
        <div class="row" role="radiogroup" aria-label="Direction of the search">
          ${n.map(e=>t`
              <label class="line">
                <input type="radio" name="way" .checked=${e===r} @change=${()=>this.direction=e} />
                begins in ${e>0?`positive`:`negative`} direction
              </label>
            `)}
        </div>
        <div class="fields">${this.needs().map(e=>this.trial(e))}</div>
        ${i.length>0?t`<div class="row">
              <button class="primary" ?disabled=${!this.usable} @click=${()=>this.#p()}>Write ${i.length}</button>
              <button @click=${()=>this.values={...this.read}}>Undo</button>
            </div>`:d}
      </section>
    `}async#p(){await this.writeTried(),this.tried.length===0&&i(`Written`)}#m(e){let n=(e,n,r=d)=>t`
      <li><span class="badge ${e?`ok`:`warn`}">${e?`good`:`look`}</span>${n} ${e?d:r}</li>
    `,r=(e,n)=>t`
      <button class="small" ?disabled=${!this.usable} @click=${()=>l(()=>this.api.act(this.device.name,n))}>
        ${e}
      </button>
    `;if(!e)return d;let{axis:i}=this,a=e.enabled!==!1,o=F.filter(([e])=>e!==`index`&&this.#e.get(e)?.size===1).map(([,e])=>e),s=F.filter(([t])=>t!==`index`&&e[t]===!0).map(([,e])=>e);return t`
      <section class="panel stack" aria-label="Before it goes">
        ${this.#l(4,`Is all well?`)}
        <ul>
          ${n(a,a?`The motor has power.`:`The motor has no power.`,r(`Power on`,{do:`power`,axis:i,on:!0}))}
          ${n(e.error===null,e.error??`No error.`,r(`Clear`,{do:`clear_error`,axis:i}))}
          ${n(e.speed===0,e.speed===0?`The axis rests.`:`The axis moves.`,r(`Stop`,{do:`stop`,axis:i}))}
          ${n(o.length===0,o.length===0?`All switches were seen to work.`:`Not seen to change: ${o.join(`, `)}.`)}
          ${s.length===0?n(!0,`No switch is on.`):n(!1,`On now: ${s.join(`, `)}. The search begins there.`)}
        </ul>
      </section>
    `}#h(e,n,r){let i=this.usable&&this.tried.length===0&&e?.error===null&&e.enabled!==!1;return t`
      <section class="panel stack" aria-label="Go">
        ${this.#l(5,`Go`)}
        <div class="row">
          ${this.running?t`<button class="stop" @click=${()=>this.#c()}>Stop</button>`:t`<button class="primary" ?disabled=${!i} @click=${()=>this.#s(n,r)}>
                Home ${this.axis} by ${n.name}, ${r>0?`positive`:`negative`}
              </button>`}
          <span class="badge ${this.running?`busy`:``}">${e?.state??``}</span>
          <span>Position <strong>${c(e?.position)}</strong></span>
        </div>
        ${this.result===null?d:t`<p role="status" class=${this.result.ok?``:`error-text`}>
              <span class="badge ${this.result.ok?`ok`:`error`}">${this.result.ok?`home`:`not home`}</span>
              ${this.result.text}
            </p>`}
      </section>
    `}};customElements.define(`pt-homing-wizard`,Ce);function I(e,t,n,r,i){let a=Math.max(t-e,0),o=Math.max(n-e,0);return a===0||r<=0?0:i?o/r*Math.sqrt(a/o):a/r}function L({low:e,high:t,seconds:n}){return(e+t)/2*n}function we(e){let{sCurve:t,topPps:n}=e,r=Math.abs(e.pulses),i=Math.min(e.startPps,n),a=Math.min(e.stopPps,n),o=r=>[{low:i,high:r,seconds:I(i,r,n,e.acceleration,t),sCurve:t},{low:a,high:r,seconds:I(a,r,n,e.deceleration,t),sCurve:t}],s=e=>o(e).reduce((e,t)=>e+L(t),0),c=s(n)<=r,l=c?n:Te(Math.max(i,a),n,e=>s(e)<=r),[u,d]=o(l),f=Math.max(r-L(u)-L(d),0),p=l>0?f/l:0;return{up:u,cruiseSeconds:p,down:d,peakPps:l,seconds:u.seconds+p+d.seconds,pulses:r,reached:c}}function Te(e,t,n){for(let r=0;r<60;r+=1){let r=(e+t)/2;n(r)?e=r:t=r}return e}function R(e,t){let{low:n,high:r}=e;if(e.seconds===0)return[r,0];let i=Math.min(Math.max(t/e.seconds,0),1),a=r-n,o=e.sCurve?i<.5?2*i*i:1-2*(1-i)**2:i,s=e.sCurve?i<.5?2/3*i**3:i-.5+2/3*(1-i)**3:i*i/2;return[n+a*o,(n*i+a*s)*e.seconds]}function Ee(e,t){let{up:n,down:r,cruiseSeconds:i,peakPps:a}=e,o=Math.min(Math.max(t,0),e.seconds);if(o<=n.seconds){let[e,t]=R(n,o);return{seconds:o,pps:e,pulses:t}}if(o<=n.seconds+i)return{seconds:o,pps:a,pulses:L(n)+(o-n.seconds)*a};let[s,c]=R(r,e.seconds-o);return{seconds:o,pps:s,pulses:e.pulses-c}}function De(e,t){let n=Array.from({length:t},(n,r)=>e.seconds*r/(t-1)),r=[e.up.seconds,e.up.seconds+e.cruiseSeconds];return[...n,...r].sort((e,t)=>e-t).map(t=>Ee(e,t))}var z=900,B=260,[V,H,U,W]=[70,76,12,30],Oe=241,ke=4,Ae=class extends A{static properties={...A.properties,distance:{state:!0}};static styles=[s,k,u`
      svg {
        display: block;
        width: 100%;
        height: auto;
        font-size: 12px;
      }
      .grid {
        stroke: var(--line);
      }
      .frame {
        fill: none;
        stroke: var(--strong-line);
      }
      text {
        fill: var(--muted);
      }
      .speed {
        fill: none;
        stroke: var(--curve-1);
        stroke-width: 2.2;
      }
      .position {
        fill: none;
        stroke: var(--curve-2);
        stroke-width: 2.2;
        stroke-dasharray: 7 4;
      }
      text.of-speed {
        fill: var(--curve-1);
      }
      text.of-position {
        fill: var(--curve-2);
      }
    `];constructor(){super(),this.distance=0}needs(){return ce(this.catalog,this.axis)}firstUpdated(){this.distance=this.catalog.language===`tmcl`?51200:1e4}async#e(){await l(()=>this.api.act(this.device.name,{do:`move`,targets:{[this.axis]:this.distance},relative:!0}),`Move begun`)}render(){let e=Object.keys(this.values).length>0,{move:r,notes:i}=fe(this.catalog,this.axis,this.values,this.distance),a=we(r),{tried:o}=this;return t`
      <section class="panel stack" aria-label="Move">
        <div class="row">
          <h2 class="grow">Move</h2>
          ${this.picker()}
          <button class="small" ?disabled=${!this.reachable} @click=${()=>this.refresh()}>Read settings</button>
        </div>
        <div class="row end">
          <label>
            Distance [${this.catalog.units.position}]
            <input
              inputmode="numeric"
              autocomplete="off"
              .value=${String(this.distance)}
              @input=${e=>{let t=n(e.target.value);t!==null&&Number.isInteger(t)&&(this.distance=t)}}
            />
          </label>
          <button class="primary" ?disabled=${!this.usable||o.length>0||this.distance===0} @click=${()=>this.#e()}>
            Make this move
          </button>
          ${o.length>0?t`
                <button ?disabled=${!this.usable} @click=${()=>this.#t()}>Write ${o.length} tried</button>
                <button @click=${()=>this.values={...this.read}}>Undo</button>
              `:d}
        </div>
        <details>
          <summary>Settings of the ramp</summary>
          <div class="fields">${this.needs().map(e=>this.trial(e))}</div>
        </details>
      </section>
      ${e&&a.seconds>0?this.#n(a,i):t`<p class="muted">Nothing moves.</p>`}
    `}async#t(){let{length:e}=this.tried;await this.writeTried(),this.tried.length===0&&i(`${e} settings written`)}#n(e,n){let r=(e,n,r)=>t`
      <div>
        <dt>${e}</dt>
        <dd>${n} ${r}</dd>
      </div>
    `;return t`
      <section class="panel stack" aria-label="Profile">
        <dl>
          ${r(`Time`,a(e.seconds,3),`s`)}
          ${r(e.reached?`Highest speed`:`Highest speed (not the one set)`,c(Math.round(e.peakPps)),`pps`)}
          ${r(`Accelerates for`,a(e.up.seconds,3),`s`)} ${r(`Constant for`,a(e.cruiseSeconds,3),`s`)}
          ${r(`Decelerates for`,a(e.down.seconds,3),`s`)} ${r(`Distance`,c(Math.round(e.pulses)),`pulses`)}
        </dl>
        ${this.#r(e)} ${n.map(e=>t`<p class="warn-text">${e}</p>`)}
      </section>
    `}#r(n){let r=De(n,Oe),i=e=>V+e/n.seconds*(z-V-H),o=e=>B-W-e*(B-U-W),s=e=>r.map(t=>`${i(t.seconds).toFixed(1)},${o(e(t)).toFixed(1)}`).join(` `),l=this.distance<0?-1:1,u=Array.from({length:5},(e,t)=>t/ke),d=`Speed rises to ${Math.round(n.peakPps)} pulses a second and falls again within ${n.seconds.toFixed(3)} seconds.`;return t`
      <svg viewBox="0 0 ${z} ${B}" role="img" aria-label=${d}>
        ${u.map(t=>e`
            <line class="grid" x1=${V} x2=${z-H} y1=${o(t)} y2=${o(t)} />
            <line class="grid" y1=${U} y2=${B-W} x1=${i(t*n.seconds)} x2=${i(t*n.seconds)} />
            <text class="of-speed" x=${V-6} y=${o(t)+4} text-anchor="end">${c(Math.round(t*n.peakPps))}</text>
            <text class="of-position" x=${z-H+6} y=${o(t)+4}>${c(Math.round(l*t*n.pulses))}</text>
            <text x=${i(t*n.seconds)} y=${252} text-anchor="middle">${a(t*n.seconds,3)} s</text>
          `)}
        <rect class="frame" x=${V} y=${U} width=${z-V-H} height=${B-U-W} />
        <polyline class="position" points=${s(({pulses:e})=>e/n.pulses)} />
        <polyline class="speed" points=${s(({pps:e})=>e/n.peakPps)} />
      </svg>
      <p class="muted">Full: speed in pulses a second. Dashed: way in pulses.</p>
    `}};customElements.define(`pt-preview`,Ae);var G=[.001,999.999];function je(e){let t=e.filter(({pulses:e})=>e!==0),n=t.reduce((e,t)=>e+Math.abs(t.pulses),0),r=t.reduce((e,t)=>e+t.counts*Math.sign(t.pulses),0),i=n/r;if(r===0||n===0)return{ok:!1,reason:`no encoder`,exact:1/0};if(i<0)return{ok:!1,reason:`wrong way`,exact:i};let a=Number(i.toFixed(3));if(a<G[0]||a>G[1])return{ok:!1,reason:`out of range`,exact:i};let o=t.map(e=>Math.abs(e.pulses/e.counts));return{ok:!0,ratio:a,exact:i,spread:Math.max(...o)-Math.min(...o)}}var Me={"no encoder":`The encoder did not count. Is it connected, has it power, and does the motor turn?`,"wrong way":`The encoder counts against the motor. Invert the direction or the encoder in the polarity (POL).`,"out of range":`The ratio is outside ${G[0]} to ${G[1]}. Choose another microstepping or encoder decoding.`},K=[1,-1,1,-1],Ne=1e6,Pe=class extends A{static properties={...A.properties,pulses:{state:!0},trials:{state:!0},running:{state:!0}};watches=[`status`];#e=!1;static styles=[s,k,u`
      table {
        max-width: 420px;
      }
    `];constructor(){super(),this.pulses=1e3,this.trials=[],this.running=!1}disconnectedCallback(){super.disconnectedCallback(),this.#e=!0}get#t(){let e=e=>this.catalog.parameters.find(({role:t,axis:n})=>t===e&&n===this.axis)?.id??``;return{loop:e(`closed_loop`),ratio:e(`closed_loop_ratio`)}}needs(){return E(this.catalog,[this.#t.loop,this.#t.ratio])}async#n(){this.running=!0,this.#e=!1,this.trials=[],await l(()=>this.#r()),this.running=!1}async#r(){let{name:e}=this.device,{axis:t}=this;if(this.read[this.#t.loop]===0||await this.write(this.#t.loop,0))for(let n of K){let r=await P(this.api,e,t,()=>this.#e);await this.api.act(e,{do:`move`,targets:{[t]:n*this.pulses},relative:!0});let i=await P(this.api,e,t,()=>this.#e);if(this.#e)return;if(i.error!==null)throw Error(`Axis ${t} stopped: ${i.error}.`);if(i.encoder===null||r.encoder===null)throw Error(`This axis has no encoder.`);let a={pulses:i.position-r.position,counts:i.encoder-r.encoder};if(this.trials=[...this.trials,a],a.pulses!==n*this.pulses)throw Error(`The axis did not go all the way; was it stopped?`)}}#i(){return l(()=>this.api.act(this.device.name,{do:`power`,axis:this.axis,on:!0}))}async#a(){this.#e=!0,await l(()=>this.api.stop(this.device.name))}async#o(e){await this.write(this.#t.ratio,e)&&i(`${this.#t.ratio}=${e.toFixed(3)}; store it to keep it.`)}render(){let e=this.trials.length===K.length?je(this.trials):null,n=this.live.status?.axes[this.axis];return t`
      <section class="panel stack" aria-label="StepNLoop ratio">
        <div class="row">
          <h2 class="grow">StepNLoop ratio</h2>
          ${this.picker()}
        </div>
        <p class="text">
          The axis moves forward and back twice with StepNLoop off. Pulses divided by encoder counts are the ratio.
          Choose a way that is free and long enough: with more pulses the ratio gets finer.
        </p>
        <div class="row end">
          <label>
            Distance [pulses]
            <input
              inputmode="numeric"
              autocomplete="off"
              .value=${String(this.pulses)}
              @change=${e=>{let t=e.target,n=o(t.value);n!==null&&n!==0&&Math.abs(n)<=Ne?this.pulses=n:t.value=String(this.pulses)}}
            />
          </label>
          ${this.running?t`<button class="stop" @click=${()=>this.#a()}>Stop</button>`:t`<button class="primary" ?disabled=${!this.usable||n?.enabled===!1} @click=${()=>this.#n()}>
                Move and measure
              </button>`}
          ${n?.enabled===!1?t`
                <span class="warn-text">The motor has no power.</span>
                <button ?disabled=${!this.usable} @click=${()=>this.#i()}>Power on</button>
              `:d}
          <span class="muted">Now: ${this.#t.loop}=${this.values[this.#t.loop]??`–`}, ${this.#t.ratio}=${this.values[this.#t.ratio]??`–`}</span>
        </div>
        ${this.trials.length>0?this.#s():d}
        ${e===null?d:e.ok?t`
                <div class="row" role="status">
                  <span class="large">${e.ratio.toFixed(3)}</span>
                  <span class="muted">pulses a count; ${a(e.exact,6)} exactly, single moves differ by ${a(e.spread,4)}</span>
                  <button class="primary" ?disabled=${!this.usable} @click=${()=>this.#o(e.ratio)}>
                    Write ${this.#t.ratio}
                  </button>
                </div>
              `:t`<p class="error-text" role="alert">${Me[e.reason]}</p>`}
      </section>
    `}#s(){return t`
      <table aria-label="Moves">
        <thead>
          <tr>
            <th class="number">Pulses</th>
            <th class="number">Counts</th>
            <th class="number">Ratio</th>
          </tr>
        </thead>
        <tbody>
          ${this.trials.map(({pulses:e,counts:n})=>t`
              <tr>
                <td class="number">${c(e)}</td>
                <td class="number">${c(n)}</td>
                <td class="number">${a(e/n,4)}</td>
              </tr>
            `)}
        </tbody>
      </table>
    `}};customElements.define(`pt-ratio-finder`,Pe);var q=1023,J=32,Y={maxCurrent:6,standbyCurrent:7,minimum:168,down:169,hysteresis:170,up:171,start:172,filter:173,threshold:174,actualCurrent:180,stopSpeed:181,coolStepSpeed:182,slowCurrent:183,load:206};function Fe(e,t){return e===0?null:[e*J,(e+t+1)*J]}var Ie=[32,8,2,1],Le=[1,2,4,8];function X(e){return(e>>3)+1}function Re(e,t){let n=X(e);return[Math.max(n>>(t===0?1:2),1),n]}function ze(e){if(e.length===0)return null;let t=e.reduce((e,t)=>e+t,0)/e.length;return{count:e.length,least:Math.min(...e),most:Math.max(...e),mean:t}}function Be(e,t){return e===null?`Run the motor at its working speed without load.`:e.most>=1023?`The reading is at its end: lower the threshold until it is not.`:e.least===0?`The motor would stop without load: raise the threshold.`:t===null?`Now brake the motor with the highest load that it must still move.`:t.least===0?`This load counts as a stall: raise the threshold.`:t.mean>=e.mean?`The reading does not fall with the load: choose another speed or current.`:t.least>e.mean/3?`There is room: lower the threshold until the reading is just above 0 at this load.`:`The threshold fits: the reading stays above 0 at this load, and a stall is seen soon beyond it.`}var Z=20,Q=44,Ve=[0,256,512,768,q],He=class extends r{static properties={live:{attribute:!1},axis:{type:String},active:{type:Boolean},thresholds:{attribute:!1}};#e=0;#t=``;static styles=[s,u`
      canvas {
        display: block;
        width: 100%;
        height: 240px;
        border: 1px solid var(--line);
        border-radius: var(--radius);
      }
    `];constructor(){super(),this.axis=``,this.active=!1,this.thresholds=null}connectedCallback(){super.connectedCallback(),this.#e=requestAnimationFrame(()=>this.#n())}disconnectedCallback(){super.disconnectedCallback(),cancelAnimationFrame(this.#e)}#n(){this.#e=requestAnimationFrame(()=>this.#n());let e=this.renderRoot.querySelector(`canvas`);if(!e||!this.active)return;let t=Math.round(e.clientWidth*devicePixelRatio),n=Math.round(e.clientHeight*devicePixelRatio),r=document.documentElement.dataset.theme??matchMedia(`(prefers-color-scheme: dark)`).matches,i=[this.live.samples.version,this.axis,t,n,this.thresholds,r].join();i!==this.#t&&t!==0&&(this.#t=i,e.width=t,e.height=n,this.#r(e,t/devicePixelRatio,n/devicePixelRatio))}#r(e,t,n){let r=e.getContext(`2d`);if(!r)return;let i=t=>(e.style.color=`var(${t})`,getComputedStyle(e).color),a=this.live.samples,o=e=>Q+(e-a.last+Z)/Z*(t-Q),s=e=>n-8-e/q*(n-16);r.scale(devicePixelRatio,devicePixelRatio),r.font=`12px sans-serif`,r.textAlign=`right`;for(let e of Ve)r.fillStyle=i(`--muted`),r.fillText(String(e),38,s(e)+4),r.strokeStyle=i(`--line`),$(r,[Q,s(e)],[t,s(e)]);if(this.thresholds){let[e,n]=this.thresholds;r.globalAlpha=.18,r.fillStyle=i(`--ok`),r.fillRect(Q,s(n),t-Q,s(e)-s(n)),r.globalAlpha=1,r.strokeStyle=i(`--ok`);for(let i of[e,n])$(r,[Q,s(i)],[t,s(i)])}if(!a.has(this.axis,`load`))return;let c=a.time(),l=a.values(this.axis,`load`);r.strokeStyle=i(`--curve-1`),r.lineWidth=1.8,r.beginPath();for(let e=0;e<c.length;e+=1){let t=o(c[e]??0);t>=Q&&r.lineTo(t,s(l[e]??0))}r.stroke()}render(){return t`<canvas role="img" aria-label="Load value over the last ${Z} seconds"></canvas>`}};customElements.define(`pt-load-curve`,He);function $(e,t,n){e.beginPath(),e.moveTo(...t),e.lineTo(...n),e.stroke()}var Ue=3,We=400,Ge=1e3,Ke=class extends A{static properties={...A.properties,speed:{state:!0},free:{state:!0},loaded:{state:!0},current:{state:!0}};watches=[`status`];#e=0;static styles=[s,k,u`
      .sliders {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(270px, 1fr));
        gap: 10px 18px;
      }
      .slider {
        display: grid;
        grid-template-columns: 1fr auto;
        gap: 2px 8px;
        font-size: 13px;
        color: var(--text);
      }
      .slider input {
        grid-column: 1 / 3;
        width: 100%;
      }
      .slider .what {
        grid-column: 1 / 3;
        color: var(--muted);
        font-size: 12px;
      }
      ol {
        margin: 0;
        padding-left: 20px;
      }
      li {
        margin-bottom: 8px;
      }
      meter {
        width: 220px;
        height: 16px;
      }
    `];constructor(){super(),this.speed=Ge,this.free=null,this.loaded=null,this.current=null}connectedCallback(){super.connectedCallback(),this.#e=window.setInterval(()=>void this.#t(),We)}disconnectedCallback(){super.disconnectedCallback(),clearInterval(this.#e)}async#t(){if(!this.active||!this.reachable)return;let e=await this.api.parameter(this.device.name,this.#n(`actualCurrent`)).catch(()=>null);this.current=typeof e==`number`?e:null}#n(e){return`AP${Y[e]}.${this.axis}`}#r(e){return Number(this.values[this.#n(e)]??0)}needs(){return E(this.catalog,Object.keys(Y).map(e=>this.#n(e)))}#i(){let{samples:e}=this.live;if(!e.has(this.axis,`load`))return null;let t=e.time();return ze([...e.values(this.axis,`load`).filter((n,r)=>(t[r]??0)>e.last-Ue)])}async#a(e){await l(()=>this.api.act(this.device.name,{do:`jog`,axis:this.axis,direction:e,speed:this.speed}))}render(){let e=this.live.status?.axes[this.axis],[n,r]=[this.#r(`start`),this.#r(`hysteresis`)],i=Fe(n,r),a=e!==void 0&&e.speed!==0;return t`
      <section class="panel stack" aria-label="Load">
        <div class="row">
          <h2 class="grow">Load value</h2>
          <span class="large" aria-label="Load value">${c(e?.load)}</span>
          <span class="muted">0 is a stall</span>
        </div>
        <pt-load-curve .live=${this.live} .axis=${this.axis} .active=${this.active} .thresholds=${i}></pt-load-curve>
        <div class="row end">
          <label>
            Speed [int]
            <input
              inputmode="numeric"
              autocomplete="off"
              .value=${String(this.speed)}
              @change=${e=>{let t=e.target,n=o(t.value);n!==null&&n>0&&n<=2047?this.speed=n:t.value=String(this.speed)}}
            />
          </label>
          <button ?disabled=${!this.usable} @click=${()=>this.#a(-1)}>◀ Turn</button>
          <button ?disabled=${!this.usable} @click=${()=>this.#a(1)}>Turn ▶</button>
          <button class="stop" @click=${()=>l(()=>this.api.stop(this.device.name))}>Stop</button>
          <span class="muted">${e?.state??``}</span>
        </div>
      </section>
      ${this.#o(a)} ${this.#s(i)}
    `}#o(e){let n=e=>e===null?d:t`<span class="muted">${c(e.least)} to ${c(e.most)}, mean ${c(Math.round(e.mean))}</span>`;return t`
      <section class="panel stack" aria-label="StallGuard2">
        <h2>StallGuard2</h2>
        <ol class="text">
          <li>Let the motor turn at its working speed and without load. Begin with a threshold of 0.</li>
          <li>
            <span class="row">
              <button class="small" ?disabled=${!e} @click=${()=>this.free=this.#i()}>Take free</button>
              ${n(this.free)}
            </span>
          </li>
          <li>Brake the shaft with the highest load that it must still move (virtual: the load in the tab I/O).</li>
          <li>
            <span class="row">
              <button class="small" ?disabled=${!e} @click=${()=>this.loaded=this.#i()}>Take loaded</button>
              ${n(this.loaded)}
            </span>
          </li>
          <li>Move the threshold, and take both again: the reading shall be just above 0 at this load.</li>
        </ol>
        <p role="status"><strong>${Be(this.free,this.loaded)}</strong></p>
        <div class="sliders">
          ${this.#c(`threshold`)} ${this.#c(`filter`)}
          ${this.#c(`stopSpeed`,e=>e===0?`never stops`:`stops above ${e}`)}
        </div>
      </section>
    `}#s(e){let[n,r]=Re(this.#r(`maxCurrent`),this.#r(`minimum`)),i=this.current===null?null:this.current+1;return t`
      <section class="panel stack" aria-label="CoolStep">
        <h2>CoolStep</h2>
        <p class="text">
          ${e===null?`Off while the hysteresis start is 0. Raise it until the band lies where the load value is at the usual load.`:`Below ${e[0]} the current grows, above ${e[1]} it falls, between ${n}/32 and ${r}/32 of the module's.`}
          Tune StallGuard2 first, and switch its filter on.
        </p>
        <div class="row">
          <span>Current now</span>
          <meter min="0" max="32" .value=${i??0} aria-label="Current now"></meter>
          <strong>${i===null?`–`:`${i}/32`}</strong>
        </div>
        <div class="sliders">
          ${this.#c(`start`,e=>e===0?`off`:`below ${32*e}`)}
          ${this.#c(`hysteresis`,()=>e?`above ${e[1]}`:``)}
          ${this.#c(`minimum`,e=>e===0?`a half`:`a quarter`)}
          ${this.#c(`down`,e=>`${Ie[e]??`?`} readings a step`)}
          ${this.#c(`up`,e=>`${Le[e]??`?`} steps a reading`)}
          ${this.#c(`coolStepSpeed`,e=>`above ${e}`)}
          ${this.#c(`slowCurrent`,e=>`${X(e)}/32 below that speed`)}
          ${this.#c(`maxCurrent`,e=>`${X(e)}/32`)}
        </div>
      </section>
    `}#c(e,n=()=>``){let r=this.#n(e),i=this.catalog.parameters.find(e=>e.id===r);if(!i||this.values[r]===void 0)return d;let a=this.#r(e),o=e=>Number(e.target.value);return t`
      <label class="slider" title=${i.text}>
        <span>${i.name} <code>${r}</code></span>
        <strong>${a}</strong>
        <input
          type="range"
          min=${i.low??0}
          max=${i.high??0}
          .value=${String(a)}
          ?disabled=${!this.usable}
          @input=${e=>this.values={...this.values,[r]:o(e)}}
          @change=${e=>this.write(r,o(e))}
        />
        <span class="what">${n(a)}</span>
      </label>
    `}};customElements.define(`pt-tuning`,Ke);var qe=[{id:`units`,title:`Units`},{id:`preview`,title:`Motion profile`},{id:`homing`,title:`Homing`},{id:`ratio`,title:`StepNLoop ratio`,fits:e=>e.parameters.some(({role:e})=>e===`closed_loop_ratio`)},{id:`tuning`,title:`StallGuard & CoolStep`,fits:e=>e.parameters.some(({id:e})=>e.startsWith(`AP174.`))}],Je=class extends m{static properties={...m.properties,chosen:{state:!0}};static styles=[s,u`
      .choice {
        margin-bottom: var(--gap);
      }
    `];constructor(){super(),this.chosen=`units`}render(){return t`
      <div class="row choice" role="group" aria-label="Tools">
        ${qe.filter(({fits:e})=>e?.(this.catalog)??!0).map(({id:e,title:n})=>t`
            <button aria-pressed=${e===this.chosen} @click=${()=>this.chosen=e}>${n}</button>
          `)}
      </div>
      ${this.#e()}
    `}#e(){let{device:e,catalog:n,live:r,api:i,control:a,active:o}=this;switch(this.chosen){case`units`:return t`<pt-calculator .device=${e} .catalog=${n} .live=${r} .api=${i} .control=${a} .active=${o}></pt-calculator>`;case`preview`:return t`<pt-preview .device=${e} .catalog=${n} .live=${r} .api=${i} .control=${a} .active=${o}></pt-preview>`;case`homing`:return t`<pt-homing-wizard .device=${e} .catalog=${n} .live=${r} .api=${i} .control=${a} .active=${o}></pt-homing-wizard>`;case`ratio`:return t`<pt-ratio-finder .device=${e} .catalog=${n} .live=${r} .api=${i} .control=${a} .active=${o}></pt-ratio-finder>`;case`tuning`:return t`<pt-tuning .device=${e} .catalog=${n} .live=${r} .api=${i} .control=${a} .active=${o}></pt-tuning>`;default:return d}}};customElements.define(`pt-tools`,Je);